#!/usr/bin/python3
"""What `firn run` writes: frames, run.json, diagnostics.csv, progress."""

import os
import pty
import re
import subprocess

from firn_cli import BLOCK, SCENES, SNOW, FirnTest, programs, diagnostics, frame_name, hashes, main, run_record, start

COLUMNS = ("frame time steps dt_min dt_max particles mass momentum_x momentum_y momentum_z angular_x angular_y "
           "angular_z kinetic elastic gravity dissipated total max_speed min_J max_J").split()


class Frames(FirnTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("block.toml", BLOCK)
        self.out = self.path("out")

    def test_a_range_writes_only_its_frames_and_they_are_those_of_the_whole_run(self):
        self.firn("run", self.scene, "--out", self.out)
        self.assert_only_whole_frames(self.out, [1, 2, 3, 4, 5])
        whole = dict(hashes(self.out))
        for text, numbers in (("2:3", [2, 3]), (":2", [1, 2]), ("4:", [4, 5]), ("5:5", [5])):
            part = self.path("part" + text.replace(":", "_"))
            self.firn("run", self.scene, "--out", part, "--frames", text)
            self.assert_only_whole_frames(part, numbers)
            self.assertEqual(hashes(part), [(number, whole[number]) for number in numbers])
            self.assertEqual([row["frame"] for row in diagnostics(part)[1]], numbers)

    def test_without_out_the_folder_is_named_after_the_scene(self):
        self.firn("run", self.scene, "--frames", "1:1")
        self.assert_only_whole_frames(self.path("out", "block"), [1])

    def test_a_replaced_value_acts_like_the_same_value_in_the_scene(self):
        self.firn("run", self.scene, "--out", self.out, "--set", "bodies.block.velocity=[0, 2, 0]", "--set",
                  "materials.rubber.density=500")
        other = self.write("other.toml", BLOCK.replace("[1, 0, 0]", "[0, 2, 0]").replace("1000", "500"))
        self.firn("run", other, "--out", self.path("other"))
        self.assertEqual(hashes(self.out), hashes(self.path("other")))
        self.firn("run", self.scene, "--out", self.path("plain"))
        self.assertNotEqual(hashes(self.out), hashes(self.path("plain")))


class Threads(FirnTest):
    def test_any_number_of_threads_gives_the_same_bits(self):
        scene = self.write("snow.toml", SNOW)
        seen = {}
        for threads in (1, 2, 3, 8):
            out = self.path(str(threads))
            self.firn("run", scene, "--out", out, "--threads", threads, "--set", "simulation.duration=0.025")
            self.assertEqual(run_record(out)["threads"], threads)
            with open(os.path.join(out, "diagnostics.csv"), encoding="utf-8") as text:
                seen[threads] = (hashes(out), text.read())
        # Otherwise equal hashes would say little.
        self.assertEqual(len({content for _, content in seen[1][0]}), 2)
        for threads, results in seen.items():
            self.assertEqual(results, seen[1], f"{threads} threads differ from one")


class Reporting(FirnTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("block.toml", BLOCK)

    def test_progress_is_plain_lines_on_standard_error_when_it_is_no_terminal(self):
        done = self.firn("run", self.scene)
        self.assertEqual(done.stdout, "")
        *frames, last, cost = done.stderr.splitlines()
        self.assertEqual([line.split("  ")[0] for line in frames], [f"frame {k}/5" for k in range(1, 6)])
        for line in frames[1:]:
            self.assertRegex(line, r"  dt \S+ s  \d+ steps  [\d.]+ M particles/s  .*(left|done in) ?.*written$")
        self.assertTrue(last.startswith("finished: 5 frames, "), last)
        self.assertTrue(cost.startswith("cost: "), cost)
        self.assertNotRegex(done.stderr, "[\r\x1b]")

    def test_progress_is_one_line_drawn_over_on_a_terminal(self):
        ours, theirs = pty.openpty()
        run = subprocess.Popen([programs["firn"], "run", self.scene, "--out", self.path("out")],
                               stdout=subprocess.PIPE, stderr=theirs)
        os.close(theirs)
        shown = b""
        try:
            while data := os.read(ours, 4096):
                shown += data
        except OSError:  # how Linux reports that the other end is closed
            pass
        os.close(ours)
        self.assertEqual((run.communicate()[0], run.returncode), (b"", 0))
        drawn = shown.decode().split("\r\n")
        self.assertRegex(drawn[0], r"^(\rframe \d/5 .*\x1b\[K){2,}$")
        # The first frame may be written while steps of the second are shown already.
        frames = [int(number) for number in re.findall(r"\rframe (\d)", drawn[0])]
        self.assertEqual(frames, sorted(frames))
        self.assertEqual(frames[-1], 5)
        self.assertTrue(drawn[1].startswith("finished: "), drawn)

    def test_run_json_holds_the_scene_as_resolved_and_what_the_run_took(self):
        out = self.path("out")
        self.firn("run", self.scene, "--out", out, "--threads", "1")
        record = run_record(out)
        self.assertEqual(record["state"], "finished")
        self.assertEqual(record["versions"]["firn"], self.firn("--version").stdout.split()[1])
        expected = self.plan(self.scene)
        self.assertEqual(record["plan"], expected)
        self.assertEqual(record["particles"], expected["estimate"]["particles"])
        for frame in record["frames"]:
            file = os.path.join(out, frame["file"])
            self.assertEqual(os.path.getsize(file), frame["bytes"])
            self.assertTrue(re.fullmatch("[0-9a-f]{16}", frame["content_xxh3"]))
        seconds = record["seconds"]
        # What follows one another; the frames are written beside it.
        parts = [seconds["seeding"], seconds["snapshot"], seconds["output_wait"], *seconds["passes"].values()]
        self.assertTrue(all(part >= 0 for part in parts))
        self.assertLessEqual(sum(parts), seconds["total"])
        self.assertTrue(0 < seconds["output"] <= seconds["total"])

    def test_every_part_of_the_scene_has_its_price_and_no_other_part(self):
        out = self.path("out")
        done = self.firn("run", os.path.join(SCENES, "snow_on_wedge.toml"), "--out", out, "--frames", ":3")
        record = run_record(out)
        costs = {cost["part"]: cost for cost in record["costs"]}
        self.assertEqual(set(costs), {"particles", "sort", "transfer", "snow", "grid", "gravity", "wedge", "ground",
                                      "frame totals", "caches"})
        self.assertEqual(costs["snow"]["effects"], ["elasticity", "decomposition", "plasticity", "hardening"])
        self.assertEqual(costs["wedge"]["kind"], "collider")
        self.assertAlmostEqual(sum(cost["share"] for cost in costs.values()), 1, places=9)
        self.assertEqual(sum(cost["bytes"] for cost in costs.values()), record["bytes"])
        self.assertGreater(costs["snow"]["seconds"], 0)
        # The parts of the passes are all of their time.
        passes = sum(record["seconds"]["passes"].values())
        others = sum(costs[part]["seconds"] for part in ("frame totals", "caches"))
        self.assertAlmostEqual(sum(cost["seconds"] for cost in costs.values()) - others, passes, places=9)
        self.assertRegex(done.stderr.splitlines()[-1],
                         r"^cost: .*snow \d+ % \(elasticity, decomposition, plasticity, hardening\), .*collider wedge \d")

    def test_what_the_scene_does_not_name_has_no_price(self):
        out = self.path("out")
        self.firn("run", os.path.join(SCENES, "elastic_cubes.toml"), "--out", out, "--frames", ":2")
        record = run_record(out)
        parts = {cost["part"] for cost in record["costs"] if "kind" not in cost}
        self.assertEqual(parts, {"particles", "sort", "transfer", "grid", "frame totals", "caches"})
        for cost in record["costs"]:
            if cost.get("kind") == "material":
                self.assertEqual(cost["effects"], ["elasticity"])

    def test_a_frame_is_reported_when_it_is_on_disk(self):
        out = self.path("out")
        # A frame of 64,000 particles, which takes longer to write than to notice that it is not there.
        run = start("run", self.scene, "--out", out, "--set", "simulation.cell_size=0.02", "--set",
                    "simulation.duration=0.01", "--set", "simulation.frame_rate=400")
        self.addCleanup(run.communicate)
        seen = 0
        for line in run.stderr:
            if line.startswith("frame "):
                seen += 1
                self.assertTrue(line.startswith(f"frame {seen}/5 "), line)
                self.assertTrue(os.path.exists(os.path.join(out, frame_name(seen))), line)
                self.assertGreaterEqual(len(diagnostics(out)[1]), seen)
        self.assertEqual((run.wait(), seen), (0, 5))


class Diagnostics(FirnTest):
    def test_the_table_has_the_columns_of_the_contract_and_fits_run_json(self):
        scene, out = self.write("snow.toml", SNOW), self.path("out")
        self.firn("run", scene, "--out", out)
        header, rows = diagnostics(out)
        self.assertEqual(header[:len(COLUMNS)], COLUMNS)
        counters = header[len(COLUMNS):]
        self.assertGreaterEqual(len(counters), 1)
        record = run_record(out)
        self.assertEqual([row["frame"] for row in rows], [frame["frame"] for frame in record["frames"]])
        self.assertEqual([row["time"] for row in rows], [frame["time"] for frame in record["frames"]])
        self.assertEqual(sum(row["steps"] for row in rows), record["steps"])
        self.assertEqual({row["particles"] for row in rows}, {record["particles"]})
        self.assertEqual(len({row["mass"] for row in rows}), 1, "mass is conserved exactly")
        for before, row in zip([None] + rows, rows):
            self.assertTrue(all(row[name] == int(row[name]) >= 0 for name in counters))
            self.assertLessEqual(row["min_J"], row["max_J"])
            energies = [row[name] for name in ("kinetic", "elastic", "gravity", "dissipated")]
            # Sums of five doubles.
            self.assertAlmostEqual(row["total"], sum(energies), delta=1e-12 * sum(map(abs, energies)))
            if before:
                self.assertLessEqual(0 < row["dt_min"] and row["dt_min"], row["dt_max"])
                span = row["time"] - before["time"]
                # The steps of a frame fill it; sums of as many doubles, and the last step ends on the frame.
                self.assertLessEqual(row["steps"] * row["dt_min"], span * (1 + 1e-9))
                self.assertGreaterEqual(row["steps"] * row["dt_max"], span * (1 - 1e-9))
                self.assertGreaterEqual(row["dissipated"], before["dissipated"])


if __name__ == "__main__":
    main()
