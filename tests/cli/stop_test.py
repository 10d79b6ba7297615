#!/usr/bin/python3
"""A run that is stopped, and a folder that a run holds."""

import os
import signal
import time

from firn_cli import BLOCK, ENDLESS, FirnTest, diagnostics, frame_name, main, run_record, start

PATIENCE = 60  # s; a frame takes milliseconds, a loaded machine may take seconds


class Running(FirnTest):
    def start_endless(self):
        """A run that goes on until it is stopped, once its second frame is there."""
        self.out = self.path("out")
        run = start("run", self.write("block.toml", BLOCK), "--out", self.out, *ENDLESS)
        self.addCleanup(self.end, run)
        deadline = time.monotonic() + PATIENCE
        while not os.path.exists(os.path.join(self.out, frame_name(2))):
            self.assertIsNone(run.poll(), "the run ended by itself")
            self.assertLess(time.monotonic(), deadline, "no second frame")
            time.sleep(0.01)
        return run

    @staticmethod
    def end(run):
        if run.poll() is None:
            run.kill()
        run.communicate()


class Signals(Running):
    def assert_stops(self, number, code):
        run = self.start_endless()
        run.send_signal(number)
        stdout, stderr = run.communicate(timeout=PATIENCE)
        self.assertEqual(run.returncode, code, stderr)
        self.assertEqual(stdout, "")
        self.assertIn("stopped", stderr)

        record = run_record(self.out)
        self.assertEqual(record["state"], "stopped by a signal")
        frames = [frame["frame"] for frame in record["frames"]]
        self.assertEqual(frames, list(range(1, len(frames) + 1)))
        self.assert_only_whole_frames(self.out, frames)
        for frame in record["frames"]:
            self.assertEqual(os.path.getsize(os.path.join(self.out, frame["file"])), frame["bytes"])
        self.assertEqual([row["frame"] for row in diagnostics(self.out)[1]], frames)

    def test_an_interrupted_run_ends_with_whole_frames_and_says_so(self):
        self.assert_stops(signal.SIGINT, 130)

    def test_a_terminated_run_ends_with_whole_frames_and_says_so(self):
        self.assert_stops(signal.SIGTERM, 143)

    def test_a_killed_run_leaves_whole_frames_and_its_folder_free(self):
        run = self.start_endless()
        run.kill()
        run.communicate()
        numbers = [int(name[10:14]) for name in os.listdir(self.out) if name.startswith("particles.")]
        self.assertGreaterEqual(len(numbers), 2)
        scene = self.path("block.toml")
        self.firn("run", scene, "--out", self.out, "--frames", "1:1", code=5)
        self.firn("run", scene, "--out", self.out, "--frames", "1:1", "--overwrite")
        self.assert_only_whole_frames(self.out, [1])


class Lock(Running):
    def test_a_folder_belongs_to_one_run_at_a_time(self):
        run = self.start_endless()
        for options in ([], ["--overwrite"]):
            done = self.firn("run", self.path("block.toml"), "--out", self.out, *options, code=5)
            self.assertIn("another run", done.stderr)
            self.assertIn(f"process {run.pid}", done.stderr)
        self.assertIsNone(run.poll(), "the first run was disturbed")
        self.assertTrue(os.path.exists(os.path.join(self.out, frame_name(1))))


if __name__ == "__main__":
    main()
