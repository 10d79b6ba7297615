"""Where render.py looks from and lights from, and its colours, by the scene's file name."""

# Camera and light per scene, by the scene's file name. Metres; the light's place is relative to the target.
VIEWS = {
    "snowball": dict(eye=(2.7, 1.15, 0.75), target=(-0.05, 0.43, 0.06), lens=44, key=(1.0, 2.0, 2.0), power=185),
    "snow_on_wedge": dict(eye=(0.75, 1.2, 2.6), target=(0.02, 0.44, 0.0), lens=36, key=(-2.1, 1.8, 1.1), power=205),
    "elastic_cubes": dict(eye=(0.5, 0.9, 3.2), target=(0.0, 0.0, 0.0), lens=66, key=(-1.2, 2.2, 1.4), power=85),
    "hourglass": dict(eye=(0.0, 0.14, 2.3), target=(0.0, -0.005, 0.0), lens=104, key=(-1.2, 1.6, 1.5), power=70),
    "mud_slump": dict(eye=(0.0, 0.62, 1.75), target=(0.0, 0.13, 0.0), lens=52, key=(-1.3, 1.3, 0.7), power=60),
    "foam_dollop": dict(eye=(0.0, 0.17, 0.36), target=(0.0, 0.016, 0.0), lens=48, key=(-0.7, 0.6, 0.1), power=12),
    "stretched_bar": dict(eye=(0.0, 0.35, 1.9), target=(0.0, 0.0, 0.0), lens=62, key=(-0.8, 1.5, 1.2), power=70),
    "squeezed_putty": dict(eye=(0.3, 0.12, 1.45), target=(0.0, 0.12, 0.0), lens=60, key=(-1.0, 1.2, 1.2), power=60),
    "tungsten_into_sandstone": dict(
        eye=(0.08, 0.27, 0.33), target=(0.0, -0.022, 0.0), lens=48, key=(-0.5, 0.4, 0.2), power=9
    ),
}
BODY_COLOURS = [(0.62, 0.05, 0.02), (0.01, 0.12, 0.42), (0.75, 0.50, 0.05), (0.10, 0.40, 0.15)]
# Of scenes whose materials have a colour of their own.
COLOURS = {
    "hourglass": [(0.62, 0.42, 0.20)],
    "mud_slump": [(0.075, 0.040, 0.020)],
    "foam_dollop": [(0.86, 0.87, 0.88), (0.72, 0.33, 0.03)],
    "stretched_bar": [(0.42, 0.20, 0.08), (0.42, 0.20, 0.08)],
    "squeezed_putty": [(0.10, 0.40, 0.15)],
    "tungsten_into_sandstone": [(0.55, 0.36, 0.22)],
}
