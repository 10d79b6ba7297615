#!/usr/bin/python3
"""`firn bench`: what it prints and what it refuses. How fast anything is, no test asks."""

import csv
import json
import os
import stat

from firn_cli import BLOCK, SNOW, FirnTest, main, programs

KEYS = ["case", "precision", "threads", "isa", "particles", "steps", "ns_per_particle_step", "median_ns",
        "million_per_second", "bytes_per_particle", "flops_per_particle_step", "bytes_per_particle_step",
        "fma_fraction", "bandwidth_fraction", "passes"]
OF_CEILINGS = ["flops_per_particle_step", "bytes_per_particle_step", "fma_fraction", "bandwidth_fraction"]
VS_KEYS = ["case", "precision", "threads", "isa", "particles", "ns_per_particle_step", "median_ns",
           "vs_ns_per_particle_step", "vs_median_ns", "ratio", "median_ratio"]
PASSES = ["sort", "p2g", "grid", "g2p", "material"]
WEIGHTS_KEYS = ["case", "kernel", "precision", "threads", "isa", "weights", "particles", "stored_bytes_per_particle",
                "traffic_ns", "ns_per_particle_step", "median_ns", "ratio", "passes"]

# Milliseconds; the built-in cases have a million particles.
SHORT = ["--rounds", "1", "--steps", "2"]
COARSE = ["--set", "simulation.cell_size=0.2"]


class BenchTest(FirnTest):
    def setUp(self):
        super().setUp()
        self.block = self.write("block.toml", BLOCK)
        self.snow = self.write("snow.toml", SNOW)

    def json_lines(self, *arguments):
        done = self.firn("bench", *arguments, "--json")
        self.assertEqual(done.stderr, "")
        return [json.loads(line) for line in done.stdout.splitlines()]

    def measurements(self, *arguments):
        return [line for line in self.json_lines(*arguments) if "case" in line]

    def widest(self):
        """The name of the widest instruction set here."""
        (line,) = self.measurements(self.block, *SHORT, "--threads", 1)
        return line["isa"]


class Output(BenchTest):
    def test_json_has_the_keys_others_rely_on_and_the_ceilings_on_lines_of_their_own(self):
        snow, read, fma = self.json_lines(self.snow, "--threads", "1", "--rounds", "2", "--steps", "3")[0:3]
        self.assertEqual(list(snow), KEYS)
        self.assertEqual((snow["case"], snow["precision"], snow["threads"], snow["steps"]), (self.snow, "float", 1, 3))
        if fma["ceiling"] == "read":
            fma, read = read, fma
        self.assertEqual(list(fma), ["ceiling", "isa", "precision", "threads", "gflops"])
        self.assertEqual((fma["ceiling"], fma["isa"], fma["precision"], fma["threads"]),
                         ("fma", snow["isa"], "float", 1))
        self.assertEqual(list(read), ["ceiling", "threads", "gb_per_s"])
        self.assertEqual((read["ceiling"], read["threads"]), ("read", 1))
        for line in (snow, fma, read):
            for key, value in line.items():
                if isinstance(value, float):
                    self.assertGreater(value, 0, key)

    def test_numbers_of_one_line_agree(self):
        lines = self.json_lines(self.snow, *SHORT, "--threads", "1")
        snow = lines[0]
        gflops = next(line["gflops"] for line in lines if "gflops" in line)
        gb_per_s = next(line["gb_per_s"] for line in lines if "gb_per_s" in line)
        ns = snow["ns_per_particle_step"]
        self.assertEqual(snow["median_ns"], ns, "one round is its own median")
        self.assertAlmostEqual(snow["million_per_second"] * ns, 1e3)
        self.assertAlmostEqual(snow["fma_fraction"], snow["flops_per_particle_step"] / ns / gflops)
        self.assertAlmostEqual(snow["bandwidth_fraction"], snow["bytes_per_particle_step"] / ns / gb_per_s)
        self.assertLessEqual(set(snow["passes"]), set(PASSES))
        self.assertIn("g2p", snow["passes"])
        # The passes are parts of what was timed; each is rounded.
        self.assertLessEqual(sum(snow["passes"].values()), ns * (1 + 1e-9))

    def test_work_is_counted_by_what_the_scene_computes_and_moves(self):
        (rubber,) = self.measurements(self.block, *SHORT, "--threads", "1")
        (snow,) = self.measurements(self.snow, *SHORT, "--threads", "1")
        (double,) = self.measurements(self.snow, *SHORT, "--threads", "1", "--set", "simulation.precision=double")
        self.assertGreater(snow["flops_per_particle_step"], rubber["flops_per_particle_step"])
        self.assertEqual(double["precision"], "double")
        self.assertAlmostEqual(double["bytes_per_particle_step"], 2 * snow["bytes_per_particle_step"])
        # x, F_E and F_P are read and written, mass and volume read: what is left are outboxes, 16 kB a block.
        self.assertGreater(snow["bytes_per_particle_step"], 4 * (2 * (3 + 9 + 9) + 2))
        blocks = (snow["bytes_per_particle_step"] - 4 * (2 * (3 + 9 + 9) + 2)) * snow["particles"] / 16384
        self.assertAlmostEqual(blocks, round(blocks), places=6)

    def test_csv_is_a_table_of_measurements_and_after_an_empty_line_one_of_ceilings(self):
        done = self.firn("bench", self.block, self.snow, *SHORT, "--threads", "1")
        self.assertEqual(done.stderr, "")
        tables = [list(csv.DictReader(table.splitlines(), strict=True)) for table in done.stdout.split("\n\n")]
        measurements, ceilings = tables
        self.assertEqual(list(measurements[0]), KEYS[:-1] + ["passes." + name for name in PASSES])
        self.assertEqual([row["case"] for row in measurements], [self.block, self.snow])
        self.assertEqual(list(ceilings[0]), ["ceiling", "isa", "precision", "threads", "gflops", "gb_per_s"])
        self.assertEqual([row["ceiling"] for row in ceilings], ["fma", "read"])
        for row in measurements + ceilings:
            self.assertNotIn(None, list(row) + list(row.values()), "a row is longer or shorter than its header")
        for row, empty, full in ((ceilings[0], "gb_per_s", "gflops"), (ceilings[1], "gflops", "gb_per_s")):
            self.assertEqual(row[empty], "")
            self.assertGreater(float(row[full]), 0)

    def test_a_name_with_a_comma_stays_one_cell(self):
        name = self.write('a "b", c.toml', BLOCK)
        rows = csv.DictReader(self.firn("bench", name, *SHORT, "--threads", "1").stdout.splitlines(), strict=True)
        self.assertEqual(next(rows)["case"], name)

    def test_the_order_is_scenes_then_instruction_sets_then_threads_and_nothing_is_measured_twice(self):
        cores = len(os.sched_getaffinity(0))
        threads = [1, 2] if cores > 1 else [1]
        isas = ["sse4", self.widest()]
        lines = self.measurements(self.snow, self.block, self.snow, *SHORT, "--isa", ",".join(isas + isas),
                                  "--threads", ",".join(map(str, threads)))
        self.assertEqual([(line["case"], line["isa"], line["threads"]) for line in lines],
                         [(scene, isa, n) for scene in (self.snow, self.block) for isa in isas for n in threads])

    def test_without_a_scene_the_four_targets_are_measured_on_one_thread_and_on_all_cores(self):
        cores = len(os.sched_getaffinity(0))
        lines = self.measurements(*SHORT, *COARSE)
        widest = lines[0]["isa"]
        cases = [("elastic", "float", widest), ("snow", "float", widest), ("snow", "double", widest)]
        if widest == "avx512":
            cases.append(("snow", "float", "avx2"))
        self.assertEqual([(line["case"], line["precision"], line["isa"], line["threads"]) for line in lines],
                         [(*case, n) for case in cases for n in sorted({1, cores})])

    def test_the_plain_path_is_compared_with_no_ceiling(self):
        (line,) = self.json_lines(self.snow, *SHORT, "--threads", "1", "--set", "simulation.path=plain")
        self.assertEqual(line["isa"], "plain")
        self.assertEqual(list(line), [key for key in KEYS if key not in OF_CEILINGS])


class Weights(BenchTest):
    WAYS = ["recomputed", "recomputed by node", "stored by axis", "stored by node"]

    def test_each_kernel_and_precision_has_a_line_for_each_way_of_having_weights(self):
        lines = self.json_lines("weights", "--particles", 500, "--rounds", 2)
        self.assertEqual([(line["kernel"], line["precision"], line["weights"]) for line in lines],
                         [(kernel, precision, way) for kernel in ("quadratic", "linear")
                          for precision in ("float", "double") for way in self.WAYS])
        for line in lines:
            stored = line["weights"].startswith("stored")
            self.assertEqual(list(line), [key for key in WEIGHTS_KEYS if stored or key != "traffic_ns"])
            self.assertEqual(list(line["passes"]), ["weights", "p2g", "g2p"] if stored else ["p2g", "g2p"])
            self.assertEqual(line["particles"], 512, "whole cells, eight in each")
            self.assertAlmostEqual(sum(line["passes"].values()), line["ns_per_particle_step"])
            self.assertLessEqual(line["ns_per_particle_step"], line["median_ns"])
        for i, line in enumerate(lines):
            first = lines[i - i % len(self.WAYS)]
            self.assertAlmostEqual(line["ratio"] * first["ns_per_particle_step"], line["ns_per_particle_step"])

    def test_what_is_stored_is_a_weight_and_a_gradient_for_every_node_or_a_weight_and_a_slope_for_every_node_of_an_axis(
            self):
        for line in self.json_lines("weights", "--particles", 8, "--rounds", 1):
            nodes = {"quadratic": 3, "linear": 2}[line["kernel"]]
            size = {"float": 4, "double": 8}[line["precision"]]
            # Beside them where the nodes are, and by axis where the particle is between them.
            numbers = {"stored by node": nodes**3 * 4, "stored by axis": 3 * nodes * 2 + 3}.get(line["weights"])
            expected = 0 if numbers is None else numbers * size + size
            self.assertEqual(line["stored_bytes_per_particle"], expected, line)

    def test_csv_has_the_same_rows(self):
        done = self.firn("bench", "weights", "--particles", 8, "--rounds", 1)
        self.assertEqual(done.stderr, "")
        rows = list(csv.DictReader(done.stdout.splitlines(), strict=True))
        self.assertEqual(list(rows[0]), WEIGHTS_KEYS[:-1] + ["passes.weights", "passes.p2g", "passes.g2p"])
        self.assertEqual([row["weights"] for row in rows], 4 * self.WAYS)

    def test_options_and_names_of_scenes_are_refused_not_ignored(self):
        for arguments in (["elastic", "weights"], ["--threads", "2", "weights"], ["--json", "weights"],
                          ["weights", "--steps", "2"], ["weights", "--particles", "0"], ["weights", "--rounds", "0"]):
            done = self.firn("bench", *arguments, code=2)
            self.assertEqual(done.stdout, "")
            self.assertNotEqual(done.stderr, "")


class Builds(BenchTest):
    def script(self, text):
        path = self.write("other", "#!/bin/sh\n" + text)
        os.chmod(path, stat.S_IRWXU)
        return path

    def refused(self, other, *says):
        done = self.firn("bench", self.block, *SHORT, "--threads", "1", "--vs", other, code=2)
        self.assertEqual(done.stdout, "")
        for words in [other, *says]:
            self.assertIn(words, done.stderr)

    def test_two_builds_take_turns_and_both_are_shown(self):
        lines = self.json_lines(self.block, self.snow, "--steps", "2", "--rounds", "3", "--threads", "1", "--vs",
                                programs["firn"])
        self.assertEqual([line["case"] for line in lines], [self.block, self.snow])
        for line in lines:
            self.assertEqual(list(line), VS_KEYS)
            self.assertGreater(line["particles"], 0)
            self.assertLessEqual(line["ns_per_particle_step"], line["median_ns"])
            self.assertLessEqual(line["vs_ns_per_particle_step"], line["vs_median_ns"])
            self.assertAlmostEqual(line["ratio"] * line["ns_per_particle_step"], line["vs_ns_per_particle_step"])
        done = self.firn("bench", self.block, *SHORT, "--threads", "1", "--vs", programs["firn"])
        (row,) = csv.DictReader(done.stdout.splitlines(), strict=True)
        self.assertEqual(list(row), VS_KEYS)

    def test_the_other_build_gets_the_same_question_every_round(self):
        answer = json.dumps({"case": self.block, "precision": "double", "threads": 1, "isa": "sse4", "particles": 9,
                             "ns_per_particle_step": 1000})
        log = self.path("log")
        other = self.script(f"echo \"$@\" >> '{log}'\necho '{{\"ceiling\":\"read\"}}'\necho '{answer}'\n")
        (line,) = self.json_lines(self.block, "--steps", "2", "--rounds", "3", "--threads", "1", "--isa", "sse4",
                                  "--set", "simulation.precision=double", "--vs", other)
        self.assertEqual((line["vs_ns_per_particle_step"], line["vs_median_ns"]), (1000, 1000))
        self.assertNotEqual(line["particles"], 9, "the particles are this build's own")
        with open(log, encoding="utf-8") as text:
            asked = text.read().splitlines()
        self.assertEqual(asked, [f"bench {self.block} --json --rounds 1 --threads 1 --isa sse4 --steps 2 "
                                 "--set simulation.precision=double"] * 3)

    def test_another_build_that_is_none(self):
        self.refused(self.path("nowhere"), "cannot be started", "No such file")
        self.refused(self.folder, "cannot be started")
        self.refused(self.block, "cannot be started", "Permission denied")
        self.refused(self.script("echo no such option >&2; exit 9"), "exit code 9", "no such option")
        self.refused(self.script("kill -SEGV $$"), "exit code 139")
        self.refused(self.script("echo hello"), "no measurement of", "'hello'")
        self.refused(self.script(":"), "no measurement of")
        self.refused(self.script("while :; do echo yes no yes no yes no yes no; done"), "more than")
        self.firn("bench", self.block, *SHORT, "--vs", "", code=2)

    def test_an_answer_to_another_question_is_none(self):
        answer = {"case": self.block, "precision": "float", "threads": 1, "isa": self.widest(), "particles": 9,
                  "ns_per_particle_step": 1000}
        self.firn("bench", self.block, *SHORT, "--threads", "1", "--vs", self.script(f"echo '{json.dumps(answer)}'"))
        for key, value in (("case", "x"), ("precision", "double"), ("threads", 2), ("isa", "plain"),
                           ("ns_per_particle_step", "fast"), ("particles", None)):
            self.refused(self.script(f"echo '{json.dumps({**answer, key: value})}'"), "no measurement of")

    def test_a_mistake_is_reported_before_any_build_is_run(self):
        done = self.firn("bench", "elastc", "--vs", self.script(f"touch '{self.path('ran')}'"), code=2)
        self.assertIn("elastic", done.stderr)
        self.assertFalse(os.path.exists(self.path("ran")))


class Mistakes(BenchTest):
    def refused(self, *arguments, says, code=2, **options):
        done = self.firn("bench", *arguments, *SHORT, code=code, **options)
        self.assertEqual(done.stdout, "")
        for words in says:
            self.assertIn(words, done.stderr)

    def test_a_case_that_there_is_not(self):
        self.refused("elastc", says=["'elastc'", "did you mean 'elastic'?", "snow", "no such scene file"])
        self.refused("nowhere.toml", says=["nowhere.toml", "elastic", "snow", "no such scene file"])
        self.refused(self.folder, says=[self.folder, "no regular file"])

    def test_an_instruction_set_that_there_is_not(self):
        self.refused(self.block, "--isa", "avx521", says=["'avx521'", "did you mean 'avx512'?", "avx2", "sse4"])
        self.refused(self.block, "--isa", "", says=["--isa"])

    def test_an_instruction_set_for_the_plain_path_which_has_none(self):
        for override, why in (("simulation.path=plain", 'simulation.path = "plain"'),
                              ("simulation.transfer=flip", "FLIP")):
            self.refused(self.block, "--isa", "sse4", "--set", override, says=["--isa sse4", "plain path", why])
        self.refused(self.block, "--isa", "sse4", says=["plain path", "FIRN_ISA"],
                     env={**os.environ, "FIRN_ISA": "none"})

    def test_a_number_of_threads_that_cannot_be(self):
        for threads in ("0", "-1", "1,0", "two"):
            self.refused(self.block, "--threads", threads, says=["--threads"])
        cores = len(os.sched_getaffinity(0))
        self.refused(self.block, "--threads", f"1,{cores + 1}", says=[f"--threads {cores + 1}", f"{cores} core"])

    def test_no_rounds_or_steps(self):
        self.refused(self.block, "--rounds", "0", says=["--rounds"])
        self.refused(self.block, "--steps", "0", says=["--steps"])

    def test_a_scene_without_a_step(self):
        self.refused(self.block, "--set", "simulation.duration=0.01", says=["no step", "simulation.duration"])

    def test_mistakes_in_a_scene_are_those_of_a_run(self):
        self.refused(self.block, "--set", "simulation.cfl=2", says=["--set simulation.cfl=2"])

    def test_numbers_beyond_reach_end_it_with_6(self):
        beyond = ["--set", "gravity.acceleration=[0,-1e38,0]"]
        self.refused(self.block, *beyond, code=6, says=["particle"])
        self.refused(self.block, *beyond, "--vs", programs["firn"], code=2, says=["exit code 6", "particle"])


if __name__ == "__main__":
    main()
