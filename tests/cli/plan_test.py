#!/usr/bin/python3
"""`firn plan`: what is present, what is absent, and whether the estimate fits the run."""

import json
import os

from firn_cli import SCENES, FirnTest, main, run_record

KEYS = {"scene", "title", "kernels", "effects", "effect_detail", "materials", "bodies", "estimate", "warnings"}
MATERIAL = {"name", "model", "energy", "yield", "hardening", "rate", "decomposition", "columns", "absent_columns",
            "bytes_per_particle"}
ESTIMATE = {"particles", "blocks", "particle_bytes", "grid_bytes", "peak_bytes", "frames", "disk_bytes",
            "wave_speed", "dt", "steps", "core_seconds"}


def scene(name):
    return os.path.join(SCENES, name + ".toml")


class Plan(FirnTest):
    def test_json_stands_alone_on_standard_output_with_the_keys_others_rely_on(self):
        done = self.firn("plan", scene("snowball"), "--json")
        self.assertEqual(done.stderr, "")
        plan = json.loads(done.stdout)
        self.assertEqual(set(plan), KEYS)
        self.assertEqual(set(plan["effects"]), {"present", "absent"})
        self.assertEqual(set(plan["effect_detail"]), set(sum(plan["effects"].values(), [])))
        for material in plan["materials"]:
            self.assertEqual(set(material), MATERIAL)
        for body in plan["bodies"]:
            self.assertEqual(set(body), {"name", "material", "particles"})
        self.assertEqual(set(plan["estimate"]), ESTIMATE)
        self.assertEqual(os.listdir(self.folder), [], "a plan writes nothing")

    def test_a_purely_elastic_scene_stores_no_F_P_and_decomposes_nothing(self):
        plan = self.plan(scene("elastic_cubes"))
        for effect in ("plasticity", "hardening", "decomposition", "colliders", "gravity", "friction"):
            self.assertIn(effect, plan["effects"]["absent"])
            self.assertNotIn(effect, plan["effects"]["present"])
        for material in plan["materials"]:
            self.assertIn("F_P", material["absent_columns"])
            self.assertNotIn("F_P", material["columns"])
            self.assertEqual((material["yield"], material["decomposition"]), ("none", "none"))
        text = self.firn("plan", scene("elastic_cubes")).stdout
        for words in ("- plasticity", "- decomposition", "- gravity", "no SVD", "absent: F_P"):
            self.assertIn(words, text)

    def test_snow_that_meets_a_wall_has_it_all(self):
        plan = self.plan(scene("snowball"))
        for effect in ("plasticity", "hardening", "decomposition", "colliders", "gravity"):
            self.assertIn(effect, plan["effects"]["present"])
            self.assertNotIn(effect, plan["effects"]["absent"])
        for material in plan["materials"]:
            self.assertIn("F_P", material["columns"])
        text = self.firn("plan", scene("snowball")).stdout
        for words in ("+ plasticity", "+ hardening", "+ decomposition", "+ gravity", "+ colliders", "F_P"):
            self.assertIn(words, text)

    def test_a_plastic_particle_takes_as_many_more_bytes_as_F_P(self):
        without_stress = self.plan(scene("elastic_cubes"), "--set", "output.attributes=[]")
        elastic = without_stress["materials"][0]["bytes_per_particle"]
        snow = self.plan(scene("snowball"))["materials"][0]["bytes_per_particle"]
        self.assertEqual(snow - elastic, 9 * 4)

    def test_the_number_of_particles_is_foreseen_within_two_percent(self):
        for name in ("snowball", "snow_on_wedge", "elastic_cubes"):
            with self.subTest(name):
                out = self.path(name)
                self.firn("run", scene(name), "--frames", "1:1", "--out", out)
                particles = run_record(out)["particles"]
                foreseen = self.plan(scene(name))["estimate"]["particles"]
                self.assertLessEqual(abs(foreseen - particles), 0.02 * particles)


if __name__ == "__main__":
    main()
