"""Prints what Pillow reads of an animation, and how far its pictures are from the PNG files of a folder."""
import glob
import json
import sys

import numpy
from PIL import Image

animation, pictures = sys.argv[1:3]
frames, delays, errors = [], [], []
with Image.open(animation) as image:
    for k in range(image.n_frames):
        image.seek(k)
        frames.append(numpy.asarray(image.convert("RGB"), dtype=float))
        delays.append(image.info["duration"])
for frame, path in zip(frames, sorted(glob.glob(pictures + "/*.png"))):
    errors.append(abs(frame - numpy.asarray(Image.open(path).convert("RGB"), dtype=float)).mean())
print(json.dumps({"pictures": len(frames), "delays": delays, "errors": errors}))
