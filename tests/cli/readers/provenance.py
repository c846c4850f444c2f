"""Prints what other programs read of what files say of themselves."""
import json
import struct
import sys

import numpy
from PIL import Image

result = {}
for name in ("a.png", "a.apng"):
    with Image.open(name) as image:
        result[name] = image.text
with Image.open("a.gif") as image:
    result["a.gif"] = dict(line.split("=", 1) for line in image.info["comment"].decode("ascii").split("\n"))
with open("a.glb", "rb") as file:
    _, _, _, length, _ = struct.unpack("<4sIIII", file.read(20))
    result["a.glb"] = json.loads(file.read(length))["asset"]["extras"]["drape"]
with open("a.npy.json") as file:
    result["a.npy"] = json.load(file)
result["shape"] = numpy.load("a.npy").shape
print(json.dumps(result))
