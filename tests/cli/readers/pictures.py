"""Writes a picture with each value of the Exif tag, and the same picture as Pillow turns it."""
import json
import sys

from PIL import Image, ImageOps

picture = Image.new("RGB", (48, 32), (40, 90, 200))
picture.paste((250, 20, 20), (0, 0, 16, 8))
picture.paste((20, 250, 20), (32, 0, 48, 24))
for orientation in range(1, 9):
    exif = Image.Exif()
    exif[0x0112] = orientation
    picture.save(f"{orientation}.jpg", quality=98, subsampling=0, exif=exif)
    picture.save(f"{orientation}.png", exif=exif)
    for ending in ("jpg", "png"):
        turned = ImageOps.exif_transpose(Image.open(f"{orientation}.{ending}"))
        turned.save(f"{orientation}-{ending}-turned.png", exif=b"")
print(json.dumps(8))
