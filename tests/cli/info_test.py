#!/usr/bin/python3
"""firn info: what it says of frames and of folders, beside what another reader and the run's own files say."""

import csv
import io
import json
import math
import os
import shutil
import struct

from firn_cli import BLOCK, SNOW, FirnTest, cache_rows, diagnostics, frame_name, main, run_record

F_E = [f"F_E_{i}{j}" for i in range(3) for j in range(3)]


class InfoTest(FirnTest):
    def run_text(self, text, *options):
        self.out = self.path("out")
        self.firn("run", self.write("scene.toml", text), "--out", self.out, *options)

    def frame(self, number):
        return os.path.join(self.out, frame_name(number))

    def info(self, path):
        return json.loads(self.firn("info", path, "--json").stdout)

    def refused(self, *arguments):
        done = self.firn("info", *arguments, code=2)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr


class Frame(InfoTest):
    def setUp(self):
        super().setUp()
        self.run_text(SNOW)
        self.last = self.frame(len(diagnostics(self.out)[1]))
        self.rows = cache_rows(self.last)

    def column(self, name):
        """The other reader prints as few digits as give the same float; places are doubles."""
        return [row[name] if name in "xyz" else single(row[name]) for row in self.rows]

    def test_ranges_are_those_of_the_particles(self):
        said = self.info(self.last)
        self.assertEqual(said["particles"], len(self.rows))
        self.assertEqual((said["frame"], said["time"], said["frame_rate"]), (3, 0.05, 40))
        self.assertEqual(said["voxel_size"], 0.05)
        attributes = {each["name"]: each for each in said["attributes"]}
        self.assertEqual({name: each["type"] for name, each in attributes.items()},
                         {"P": "vec3s", "id": "int64", "v": "vec3s", "pscale": "float", "F_E": "mat3s", "Jp": "float",
                          "material": "int32"})
        columns = {"P": ["x", "y", "z"], "v": ["vx", "vy", "vz"], "id": ["id"], "Jp": ["Jp"], "pscale": ["pscale"],
                   "material": ["material"], "F_E": [name.replace("_E_", "") for name in F_E]}
        for name, judged in columns.items():
            each = attributes[name]
            self.assertEqual(len(each["mean"]), len(judged))
            self.assertEqual(each["not_finite"], 0)
            for k, column in enumerate(map(self.column, judged)):
                with self.subTest(name=name, component=k):
                    self.assertEqual((each["min"][k], each["max"][k]), (min(column), max(column)))
                    # Sums in another order.
                    self.assertAlmostEqual(each["mean"][k], math.fsum(column) / len(column),
                                           delta=1e-12 * max(map(abs, column)))
        self.assertEqual((said["min"], said["max"]), (attributes["P"]["min"], attributes["P"]["max"]))

    def test_people_read_the_same_in_a_table(self):
        lines = [line.split() for line in self.firn("info", self.last).stdout.splitlines()]
        self.assertIn(f"{len(self.rows):,}", " ".join(lines[0]))
        table = {words[0]: words[-3:] for words in lines if len(words) >= 4}
        for name, column in (("v_y", "vy"), ("Jp", "Jp"), ("F_E_01", "F01")):
            numbers = self.column(column)
            for word, number in zip(table[name], (min(numbers), math.fsum(numbers) / len(numbers), max(numbers))):
                self.assertAlmostEqual(float(word), number, delta=1e-5 * max(map(abs, numbers)))

    def test_rows_are_the_particles_by_id_with_all_digits(self):
        text = self.firn("info", self.last, "--csv", "F_E,material,v").stdout
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(list(rows[0]), ["id", "x", "y", "z", *F_E, "material", "v_x", "v_y", "v_z"])
        self.assertEqual([row["id"] for row in rows], [str(k) for k in range(len(self.rows))])
        judged = sorted(self.rows, key=lambda row: row["id"])
        names = {"x": "x", "y": "y", "z": "z", "material": "material", "v_x": "vx", "v_y": "vy", "v_z": "vz",
                 **{name: name.replace("_E_", "") for name in F_E}}
        for row, particle in zip(rows, judged):
            for name, other in names.items():
                self.assertEqual(float(row[name]), particle[other])

    def test_an_attribute_that_is_not_there_is_named_with_the_nearest(self):
        message = self.refused(self.last, "--csv", "Jq")
        for words in (frame_name(3), "unknown attribute 'Jq'", "did you mean 'Jp'?",
                      "known: P, id, v, pscale, F_E, Jp, material"):
            self.assertIn(words, message)

    def test_files_that_are_no_frames_are_told_as_such(self):
        self.assertIn("no such file", self.refused(self.path("nothing.vdb")))
        self.assertIn("text.vdb", self.refused(self.write("text.vdb", "no picture of particles\n")))
        self.assertIn("empty", self.refused(self.write("empty.vdb", "")))
        with open(self.last, "rb") as file:
            whole = file.read()
        # Cut short in the header, in the tree, among the values, and by a byte.
        for size in (30, 400, len(whole) // 3, len(whole) // 2, len(whole) - 1):
            with self.subTest(size=size):
                with open(self.path("torn.vdb"), "wb") as file:
                    file.write(whole[:size])
                for more in ([], ["--csv", "Jp"]):
                    self.assertIn("torn.vdb", self.refused(self.path("torn.vdb"), *more))


def single(number):
    return struct.unpack("f", struct.pack("f", number))[0]


class Folder(InfoTest):
    def setUp(self):
        super().setUp()
        self.run_text('title = "A block that drifts"\n' + BLOCK)
        self.table = diagnostics(self.out)[1]

    def test_it_says_what_the_run_wrote(self):
        said, record = self.info(self.out), run_record(self.out)
        self.assertEqual(said["title"], "A block that drifts")
        self.assertEqual(said["frames"], [1, 2, 3, 4, 5])
        self.assertEqual((said["state"], said["particles"]), ("finished", self.table[0]["particles"]))
        self.assertEqual(said["materials"], [{"name": "rubber", "model": "neo_hookean"}])
        self.assertEqual((said["seconds"], said["steps"]), (record["seconds"]["total"], record["steps"]))
        self.assertEqual(said["last_rows"], self.table[-3:])
        text = self.firn("info", self.out).stdout
        for words in ("A block that drifts", "5 (1 to 5)", "rubber (neo_hookean)", "kinetic, J",
                      f"{self.table[-1]['total']:.5g}"):
            self.assertIn(words, text)

    def test_it_says_what_is_left_of_a_run_that_was_killed(self):
        os.remove(os.path.join(self.out, "run.json"))
        os.remove(self.frame(3))
        with open(os.path.join(self.out, "diagnostics.csv"), encoding="utf-8") as table:
            text = table.read()
        # Of the last row some columns may be missing, or only the end of its last number.
        for half in ("6,0.25,1", text.splitlines()[-1]):
            with open(os.path.join(self.out, "diagnostics.csv"), "w", encoding="utf-8") as table:
                table.write(text + half)
            self.assertEqual(self.info(self.out)["last_rows"], self.table[-3:])
        said = self.info(self.out)
        self.assertEqual(said["frames"], [1, 2, 4, 5])
        self.assertIn("not finished", said["state"])
        self.assertEqual(said["particles"], self.table[-1]["particles"])
        self.assertIn("4 (1 to 2, 4 to 5)", self.firn("info", self.out).stdout)

    def test_folders_without_a_run_and_damaged_records_are_told(self):
        self.assertIn("--csv is for a frame", self.refused(self.out, "--csv", "v"))
        os.mkdir(self.path("bare"))
        self.assertIn("holds no run", self.refused(self.path("bare")))
        for text, says in (("{", "no JSON"), ("{}", "is not that of a run"), ("[]", "is not that of a run")):
            shutil.copytree(self.out, self.path("copy"))
            with open(self.path("copy", "run.json"), "w", encoding="utf-8") as record:
                record.write(text)
            message = self.refused(self.path("copy"))
            self.assertIn("run.json", message)
            self.assertIn(says, message)
            shutil.rmtree(self.path("copy"))


if __name__ == "__main__":
    main()
