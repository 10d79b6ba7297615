#!/usr/bin/python3
"""tools/scripts/dots and movie: that what they draw is where, as large and of the colour that the caches say."""

import csv
import io
import os
import shutil
import subprocess

from PIL import Image, ImageSequence

from firn_cli import BLOCK, SOURCE, FirnTest, diagnostics, frame_name, main, programs

SCRIPTS = os.path.join(SOURCE, "tools", "scripts")
GREY, BLUEST, REDDEST = (0xb6, 0xbb, 0xc1), (0x1d, 0x4f, 0xb8), (0xb5, 0x1f, 0x1f)
PANEL, GAP, LABEL, LEGEND = 240, 16, 26, 118

LATTICE = BLOCK + 'sampling = "lattice"\n'
# Eight by eight particles in one plane.
FLAT = (LATTICE.replace("cell_size", "dimension = 2\ncell_size").replace("0.4, 0.4, 0.4", "0.4, 0.4, 0")
        + 'particles_per_cell = 4\n')


def attributes(*names):
    return "[output]\nattributes = [" + ", ".join(f'"{name}"' for name in names) + "]\n"


class PictureTest(FirnTest):
    def simulate(self, text):
        self.firn("run", self.write("scene.toml", text), "--out", self.path("run"))
        self.frames = len(diagnostics(self.path("run"))[1])
        self.first, self.last = (self.path("run", frame_name(number)) for number in (1, self.frames))

    def script(self, name, *words, code=0):
        done = subprocess.run([os.path.join(SCRIPTS, name), *words, "--firn", programs["firn"], "--width", str(PANEL)],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def rows(self, frame, *names):
        text = self.firn("info", frame, "--csv", ",".join(names)).stdout
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(io.StringIO(text))]


class Dots(PictureTest):
    def draw(self, *words):
        self.script("dots", *words, "--out", "dots.png")
        with Image.open(self.path("dots.png")) as picture:
            return picture.convert("RGBA")

    def panels(self, picture, number):
        """Without times and legend."""
        return [picture.crop((k * (PANEL + GAP), 0, k * (PANEL + GAP) + PANEL, picture.height - LABEL))
                for k in range(number)]

    def colours(self, panel):
        """Of the pixels that dots cover wholly."""
        return {pixel[:3] for pixel in panel.getdata() if pixel[3] == 255}

    def test_dots_are_drawn_where_the_particles_are(self):
        self.simulate(FLAT)
        # So small that a pixel and more is between them.
        picture = self.draw(self.first, self.last, "--cover", "0.5")
        # 0.4 m of body that drifts 0.2 m, and a cell of 0.1 m around all: 240 pixels are 0.65 to 0.66 m wide, for its
        # outermost particles stand 25 mm inside.
        self.assertEqual(picture.width, 2 * PANEL + GAP)
        self.assertAlmostEqual(picture.height, PANEL * 0.45 / 0.65 + LABEL, delta=2)
        # The left one's body is left in it, the right one's right.
        for panel, dots in zip(self.panels(picture, 2), (range(0, 168), range(72, 240))):
            self.assertEqual(self.colours(panel), {(0x3a, 0x8f, 0xe0)})
            alpha = list(panel.getchannel("A").getdata())
            for lines in (PANEL, panel.height):
                across = [alpha[k::PANEL] if lines == PANEL else alpha[k * PANEL:(k + 1) * PANEL] for k in range(lines)]
                dark = [max(line) > 0 for line in across]
                self.assertEqual(sum(a < b for a, b in zip([False, *dark], dark)), 8)
                if lines == PANEL:
                    self.assertTrue(all(k in dots for k, drawn in enumerate(dark) if drawn))

    def test_the_area_of_dots_is_that_of_the_particles(self):
        self.simulate(FLAT.replace("velocity = [1, 0, 0]", 'velocity = ["-4 * x", 0, 0]')
                      .replace("duration = 0.2", "duration = 0.05") + attributes("volume"))
        panels = self.panels(self.draw(self.first, self.last, "--cover", "0.5"), 2)
        frames = [self.rows(frame, "volume") for frame in (self.first, self.last)]
        places = [row["x"] for rows in frames for row in rows]
        scale = PANEL / (max(places) - min(places) + 0.1)
        areas = [sum(row["volume"] for row in rows) for rows in frames]
        self.assertLess(areas[1], 0.95 * areas[0])
        for panel, area in zip(panels, areas):
            # Dots are 14 pixels wide, drawn on a grid four times as fine.
            covered = sum(panel.getchannel("A").getdata()) / 255
            self.assertAlmostEqual(covered / (0.5 * area * scale**2), 1, delta=0.02)

    def test_pressure_is_red_and_tension_blue(self):
        for velocity, end in (("-2 * x", REDDEST), ("2 * x", BLUEST)):
            with self.subTest(velocity=velocity):
                self.simulate(FLAT.replace("velocity = [1, 0, 0]", f'velocity = ["{velocity}", 0, 0]')
                              .replace("duration = 0.2", "duration = 0.05") + attributes("pressure"))
                sign = 1 if end == REDDEST else -1
                pressures = [sign * row["pressure"] for row in self.rows(self.last, "pressure")]
                self.assertGreater(min(pressures), 0)
                picture = self.draw(self.first, self.last, "--colour", "pressure", "--limit", str(min(pressures) / 2))
                self.assertEqual(picture.width, 2 * PANEL + GAP + LEGEND)
                rest, pressed = map(self.colours, self.panels(picture, 2))
                self.assertEqual((rest, pressed), ({GREY}, {end}))
                half = self.draw(self.last, "--colour", "pressure", "--limit", str(3 * max(pressures)))
                for red, _, blue in self.colours(self.panels(half, 1)[0]):
                    self.assertEqual(red - blue > GREY[0] - GREY[2], sign > 0)
                self.assertNotIn(end, self.colours(self.panels(half, 1)[0]))
                # The legend shows all of the scale.
                bar = self.colours(half.crop((half.width - LEGEND, 0, half.width, half.height)))
                for colour in (BLUEST, GREY, REDDEST):
                    self.assertTrue(any(max(abs(a - b) for a, b in zip(colour, seen)) <= 3 for seen in bar), colour)
                shutil.rmtree(self.path("run"))

    def test_the_scale_may_have_another_centre(self):
        self.simulate(FLAT + attributes("density"))
        picture = self.draw(self.first, "--colour", "density", "--centre", "1000", "--limit", "10")
        self.assertEqual(self.colours(self.panels(picture, 1)[0]), {GREY})
        picture = self.draw(self.first, "--colour", "density", "--centre", "990", "--limit", "10")
        self.assertEqual(self.colours(self.panels(picture, 1)[0]), {REDDEST})

    def test_of_a_body_with_depth_its_front_is_seen(self):
        self.simulate(LATTICE)
        nearest = max(row["z"] for row in self.rows(self.first, "pscale"))
        picture = self.draw(self.first, "--colour", "P_z", "--limit", str(nearest), "--cover", "1.5")
        self.assertEqual(self.colours(self.panels(picture, 1)[0]), {REDDEST})

    def test_mistakes_are_told(self):
        self.assertIn("no such file", self.script("dots", "nothing.vdb", "--out", "a.png", code=3).stderr)
        self.simulate(FLAT + attributes("pressure", "stress"))
        draw = [self.first, "--out", "a.png"]
        self.assertIn("did you mean 'pressure'?", self.script("dots", *draw, "--colour", "presure", code=3).stderr)
        self.assertIn("choose one of stress_00, stress_01",
                      self.script("dots", *draw, "--colour", "stress", code=3).stderr)
        self.assertIn("--limit: 0 is not above 0",
                      self.script("dots", *draw, "--colour", "pressure", "--limit", "0", code=2).stderr)
        self.assertFalse(os.path.exists(self.path("a.png")))
        self.assertIn("none/a.png", self.script("dots", self.first, "--out", "none/a.png", code=3).stderr)


class Movie(PictureTest):
    def test_it_shows_every_frame_in_its_place_and_time(self):
        self.simulate(FLAT + attributes("pressure"))
        for name in ("a.webp", "a.gif", "a.png"):
            with self.subTest(name=name):
                self.script("movie", "run", name, "--colour", "pressure", "--limit", "1", "--rate", "10")
                with Image.open(self.path(name)) as movie:
                    self.assertEqual(movie.n_frames, self.frames)
                    pictures = [each.convert("RGB") for each in ImageSequence.Iterator(movie)]
                middles = []
                for picture in pictures:
                    # WebP is lossy.
                    self.assertGreater(min(picture.getpixel((PANEL + GAP // 2, 0))), 250)
                    inside = picture.crop((0, 0, PANEL, picture.height - LABEL)).convert("L")
                    dark = [k % PANEL for k, light in enumerate(inside.getdata()) if light < 220]
                    middles.append(sum(dark) / len(dark))
                # It drifts 0.2 m with even speed, of the 0.65 m that are shown.
                for k, middle in enumerate(middles):
                    self.assertAlmostEqual(middle - middles[0], k / (self.frames - 1) * PANEL * 0.2 / 0.65, delta=2)

    def test_frames_can_be_left_out(self):
        self.simulate(FLAT)
        self.script("movie", "run", "a.webp", "--every", "2")
        with Image.open(self.path("a.webp")) as movie:
            self.assertEqual(movie.n_frames, (self.frames + 1) // 2)

    def test_mistakes_are_told(self):
        self.assertIn("OUT ends in one of", self.script("movie", "run", "a.avi", code=2).stderr)
        self.assertIn("No such file", self.script("movie", "nothing", "a.gif", code=3).stderr)
        os.mkdir(self.path("bare"))
        self.assertIn("holds no frames", self.script("movie", "bare", "a.gif", code=3).stderr)


if __name__ == "__main__":
    main()
