"""Two low beams side by side: what the files say, lux on the road, and the picture of the same moment.

    python3 python/examples/compare_lamps.py
"""

import numpy as np

import phare

examples = phare.shipped_file("examples")
lamps = {name: phare.Lamp.read(examples / f"{name}.ies") for name in ("low_beam", "led_low_beam")}

for name, lamp in lamps.items():
    rated = lamp.hspr()
    verdict = lamp.check("r112-passing-b")
    said = "passes" if verdict.passed else f"fails {verdict.failed} rows of"
    print(f"{name}: {lamp.flux_lm:.0f} lm, peak {lamp.peak_cd:.0f} cd, {said} {verdict.rule}, HSPR {rated.rating}")

# Lux along the right edge of the lane, 25 cm above the road and facing the car, under a pair of each.
x = np.arange(20.0, 121.0, 20.0)
edge = np.column_stack([x, *(np.full_like(x, value) for value in (-1.75, 0.25, -1.0, 0.0, 0.0))])
print("x in m:        ", *(f"{value:7.0f}" for value in x))
for name, lamp in lamps.items():
    pair = [phare.Mounted(lamp, 3.45, y, 0.66, pitch_deg=-0.573) for y in (0.62, -0.62)]
    print(f"{name:15}", *(f"{value:7.2f}" for value in phare.measure(pair, edge)))

for name, lamp in lamps.items():
    report = phare.drive(lamp=lamp.file, frames=2, size=(160, 90))
    print(f"{name}: {report.figures['frames']} frames, mean of the last picture {report.frame(-1).mean():.1f} of 255")
