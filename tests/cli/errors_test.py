#!/usr/bin/python3
"""What firn says and returns when it cannot start or go on: exit codes 2, 3, 5, 6 and 7."""

import os

from firn_cli import BLOCK, FirnTest, diagnostics, frame_bytes, frame_name, main, run_record


class Input(FirnTest):
    def assert_refused(self, *arguments, says):
        done = self.firn(*arguments, code=2)
        self.assertEqual(done.stdout, "")
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, done.stderr)
        self.assertFalse(os.path.exists(self.path("out")), "a folder was made for a run that cannot start")
        return done.stderr

    def test_each_mistake_in_a_scene_is_named_with_its_place_in_one_pass(self):
        scene = self.write("bad.toml", BLOCK.replace("cell_size = 0.1", "cell_size = -1")
                                            .replace('"neo_hookean"', '"neo_hokean"'))
        lines = scene_lines(scene)
        for command in ("run", "plan"):
            message = self.assert_refused(command, scene, says=["bad.toml", "neo_hookean"])
            for text in ("-1", '"neo_hokean"'):
                line, column = place(lines, text)
                self.assertIn(f"bad.toml:{line}:{column}: ", message)

    def test_text_that_is_not_toml_is_named_with_its_place(self):
        self.assert_refused("run", self.write("bad.toml", "[simulation]\ncell_size = = 1\n"), says="bad.toml:2:")

    def test_a_scene_that_is_not_there(self):
        self.assert_refused("run", "nowhere.toml", says=["nowhere.toml", "no such file"])

    def test_an_unknown_option(self):
        scene = self.write("block.toml", BLOCK)
        self.assert_refused("run", scene, "--threds", "2", says="--threds")

    def test_an_unknown_command_and_none(self):
        self.assert_refused("rum", says="unknown command 'rum'; did you mean 'run'?")
        self.assert_refused(says=["subcommand", "--help"])

    def test_overrides_are_checked_like_the_scene(self):
        scene = self.write("block.toml", BLOCK)
        self.assert_refused("run", scene, "--set", "simulation.cfl=2", says=["--set simulation.cfl=2", "cfl"])
        self.assert_refused("run", scene, "--set", "simulation.cell_sice=1", says=["cell_sice", "cell_size"])
        self.assert_refused("run", scene, "--set", "nonsense", says="nonsense")

    def test_values_of_options_that_mean_nothing(self):
        scene = self.write("block.toml", BLOCK)
        for frames in ("0:2", "3:2", "1:99", "2", "a:b", "1:2:3"):
            self.assert_refused("run", scene, "--frames", frames, says=["--frames", "A:B"])
        self.assert_refused("run", scene, "--max-memory", "much", says="much")
        self.assert_refused("run", scene, "--threads", "0", says="--threads")


class Folder(FirnTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("block.toml", BLOCK)

    def test_a_folder_that_cannot_be_made(self):
        file = self.write("file", "kept")
        for out in (file, os.path.join(file, "below")):
            done = self.firn("run", self.scene, "--out", out, code=3)
            self.assertIn(out, done.stderr)
        with open(file, encoding="utf-8") as text:
            self.assertEqual(text.read(), "kept")

    def test_frames_of_an_earlier_run_are_replaced_only_on_request(self):
        out = self.path("out")
        self.firn("run", self.scene, "--out", out)
        before = {name: read(out, name) for name in os.listdir(out) if name != ".firn.lock"}
        done = self.firn("run", self.scene, "--out", out, "--frames", "1:2", code=5)
        self.assertIn("--overwrite", done.stderr)
        self.assertEqual({name: read(out, name) for name in before}, before)

        self.write("out/notes.txt", "mine")
        self.firn("run", self.scene, "--out", out, "--frames", "1:2", "--overwrite")
        self.assert_only_whole_frames(out, [1, 2])
        self.assertEqual(read(out, "notes.txt"), b"mine")

    def test_a_scene_error_leaves_an_earlier_run_alone(self):
        out = self.path("out")
        self.firn("run", self.scene, "--out", out, "--frames", "1:2")
        self.firn("run", self.scene, "--out", out, "--overwrite", "--set", "simulation.cfl=7", code=2)
        self.assert_only_whole_frames(out, [1, 2])


class Limits(FirnTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("block.toml", BLOCK)

    def test_too_little_memory_is_found_before_anything_is_written(self):
        done = self.firn("run", self.scene, "--out", self.path("out"), "--max-memory", "1M", "--set",
                         "simulation.cell_size=0.01", code=7)
        self.assertRegex(done.stderr, r"1\.\d+ MB are available; about [\d,]+ particles would fit")
        self.assertIn("simulation.cell_size", done.stderr)
        self.assertFalse(os.path.exists(self.path("out")))

    def test_what_the_message_on_memory_recommends_does_fit(self):
        tight = ["--set", "simulation.cell_size=0.01", "--max-memory", "1M"]
        message = self.firn("run", self.scene, *tight, code=7).stderr
        factor = float(message.split("by a factor of ")[1].split(" ")[0])
        # The blocks at the surface weigh more on a coarser grid, hence a little more than the factor.
        tight[1] = f"simulation.cell_size={0.01 * factor * 1.1}"
        self.firn("run", self.scene, *tight, "--frames", "1:1", "--out", self.path("out"))

    def test_numbers_beyond_reach_stop_the_run_name_a_particle_and_leave_earlier_frames(self):
        out = self.path("out")
        done = self.firn("run", self.scene, "--out", out, "--set", "gravity.acceleration=[0,-1e38,0]", code=6)
        self.assertRegex(done.stderr, r"particle \d+ of material 'rubber': x = \(")
        self.assert_only_whole_frames(out, [1])
        record = run_record(out)
        self.assertEqual(record["state"], "stopped: numerics")
        self.assertEqual([frame["frame"] for frame in record["frames"]], [1])
        self.assertEqual([row["frame"] for row in diagnostics(out)[1]], [1])

        calm = self.path("calm")
        self.firn("run", self.scene, "--out", calm, "--frames", "1:1")
        self.assertEqual(frame_bytes(os.path.join(out, frame_name(1))),
                         frame_bytes(os.path.join(calm, frame_name(1))))

    def test_a_speed_that_no_step_can_resolve_stops_the_run_instead_of_stalling_it(self):
        kicker = """
[[colliders]]
name = "kicker"
shape = { type = "box", min = [-3, -1, -1], max = [-0.1, 1, 1] }
keyframes = [ { time = 0, position = [0, 0, 0] }, { time = 0.05, position = [0, 0, 0] },
              { time = 0.0501, position = [1e25, 0, 0] } ]
"""
        kicked = self.write("kicked.toml", BLOCK + kicker)
        fast = [self.scene, "--set", "bodies.block.velocity=[1e30,0,0]"]
        for name, arguments in (("kicked", [kicked]), ("fast", fast)):
            out = self.path(name)
            done = self.firn("run", *arguments, "--out", out, code=6, timeout=60)
            self.assertIn("time step", done.stderr)
            frames = [frame["frame"] for frame in run_record(out)["frames"]]
            self.assertGreaterEqual(len(frames), 1)
            self.assert_only_whole_frames(out, frames)


def scene_lines(file):
    with open(file, encoding="utf-8") as text:
        return text.read().splitlines()


def place(lines, text):
    """Line and column, counted from one, where `text` stands alone after an equals sign."""
    return next((number, line.index("= " + text) + 3) for number, line in enumerate(lines, 1) if "= " + text in line)


def read(*names):
    with open(os.path.join(*names), "rb") as data:
        return data.read()


if __name__ == "__main__":
    main()
