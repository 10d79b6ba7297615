#!/usr/bin/python3
"""The small commands through the real binary; what they compute is tested where it is made."""

import json
import subprocess

from firn_cli import FirnTest, main, programs

LINE = {"id": "a", "dimension": 2, "dt": 1e-3, "material": {"model": "neo_hookean", "mu": 1, "lam": 1},
        "F_trial": [[1, 0], [0, 1]]}


class Commands(FirnTest):
    def element(self, *lines, code):
        done = self.firn("element", input="".join(line + "\n" for line in lines), code=code)
        self.assertEqual(done.stderr, "")
        return [json.loads(line) for line in done.stdout.splitlines()]

    def test_element_answers_each_line_and_ends_with_2_after_a_bad_one(self):
        good = json.dumps(LINE)
        (answer,) = self.element(good, code=0)
        self.assertEqual((answer["id"], answer["F_E"], answer["tau"], answer["psi"]),
                         ("a", [[1, 0], [0, 1]], [[0, 0], [0, 0]], 0))
        bad, after = self.element(json.dumps({**LINE, "id": "b", "material": {"model": "neo_hokean"}}), good, code=2)
        self.assertEqual(bad["id"], "b")
        self.assertIn("neo_hookean", bad["error"])
        self.assertEqual(after, answer)

    def test_materials_lists_every_model_or_one(self):
        every = self.firn("materials").stdout
        one = self.firn("materials", "snow_stomakhin_2013").stdout
        self.assertIn(one, every)
        self.assertIn("theta_c", one)
        self.assertNotIn("neo_hookean", one)
        done = self.firn("materials", "snow_stomakin_2013", code=2)
        self.assertEqual(done.stdout, "")
        self.assertIn("snow_stomakhin_2013", done.stderr)

    def test_the_schema_is_json_and_its_example_a_scene(self):
        schema = json.loads(self.firn("schema").stdout)
        self.assertIn("simulation", schema["properties"])
        example = self.write("example.toml", self.firn("schema", "--example").stdout)
        self.assertGreater(self.plan(example)["estimate"]["particles"], 0)

    def test_every_command_has_help_with_an_example(self):
        overview = self.firn("--help").stdout
        commands = [line.split()[0] for line in overview.split("Subcommands:\n")[1].splitlines() if line.strip()]
        for command in ("run", "plan", "element", "materials", "info", "schema"):
            self.assertIn(command, commands)
        for command in commands:
            text = self.firn(command, "--help").stdout
            self.assertRegex(text, rf"Example:\n  .*firn {command}\b")

    def test_output_that_cannot_be_written_is_an_error(self):
        # The device that is always full.
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([programs["firn"], "schema"], stdout=full, stderr=subprocess.PIPE, text=True,
                                  check=False)
        self.assertEqual(done.returncode, 4)
        self.assertIn("standard output", done.stderr)


if __name__ == "__main__":
    main()
