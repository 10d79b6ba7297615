#!/usr/bin/python3
"""A write that fails ends the run with exit code 4 and leaves the frames before it as they were."""

import ctypes
import os
import resource
import subprocess

from firn_cli import BLOCK, FirnTest, diagnostics, frame_bytes, frame_name, main

CLONE_NEWNS = 0x00020000  # of sched.h


class Disk(FirnTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("block.toml", BLOCK)
        self.whole = self.path("whole")
        self.firn("run", self.scene, "--out", self.whole)

    def assert_fails_cleanly(self, out, **options):
        done = self.firn("run", self.scene, "--out", out, code=4, **options)
        frames = [int(row["frame"]) for row in diagnostics(out)[1]]
        self.assertGreaterEqual(len(frames), 1, "the first frame should have had room")
        self.assertLess(len(frames), 5, "the last frame should have had none")
        self.assertIn(frame_name(frames[-1] + 1), done.stderr)
        self.assert_only_whole_frames(out, frames)
        for number in frames:
            self.assertEqual(frame_bytes(os.path.join(out, frame_name(number))),
                             frame_bytes(os.path.join(self.whole, frame_name(number))))
        return done.stderr


class FileTooLarge(Disk):
    def test_a_frame_above_the_limit_on_file_size(self):
        # At rest every velocity is equal and stored once, so the first frame is the smallest.
        first, second = (os.path.getsize(os.path.join(self.whole, frame_name(number))) for number in (1, 2))
        self.assertLess(first, second)
        limit = (first + second) // 2
        self.assert_fails_cleanly(self.path("out"), preexec_fn=lambda: resource.setrlimit(
            resource.RLIMIT_FSIZE, (limit, limit)))

    def test_a_run_does_not_compute_the_next_frame_when_the_one_before_it_cannot_be_written(self):
        # 64,000 particles; the second frame would take many minutes.
        done = self.firn("run", self.scene, "--out", self.path("out"), "--set", "simulation.cell_size=0.02", "--set",
                         "simulation.frame_rate=2e-3", "--set", "simulation.duration=500", code=4, timeout=30,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
        self.assertIn(frame_name(1), done.stderr)
        self.assert_only_whole_frames(self.path("out"), [])


class DiskFull(Disk):
    def test_a_disk_that_fills_up(self):
        # Two frames and the small files, not three.
        size = sum(os.path.getsize(os.path.join(self.whole, frame_name(number))) for number in (1, 2, 2))
        small = self.path("small")
        os.mkdir(small)
        # Mounts that only this process sees: they go with it, even if it is killed.
        if ctypes.CDLL(None).unshare(CLONE_NEWNS) != 0:
            self.skipTest("SKIPPED: only root can mount a small disk")
        for command in (["mount", "--make-rprivate", "/"],
                        ["mount", "-t", "tmpfs", "-o", f"size={size // 4096 * 4096}", "tmpfs", small]):
            done = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
            if done.returncode != 0:
                self.skipTest("SKIPPED: cannot mount a small disk: " + done.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", small], check=True)
        message = self.assert_fails_cleanly(os.path.join(small, "out"))
        self.assertIn("No space left on device", message)
        # The warning comes before the first step.
        self.assertRegex(message.splitlines()[0], r"^warning: .* free, and the run is expected to write")


if __name__ == "__main__":
    main()
