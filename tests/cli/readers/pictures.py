"""Writes pictures whose Exif data say how they are turned, and each as Pillow turns it; prints their names."""
import io
import json
import struct
import zlib

from PIL import Image, ImageOps

picture = Image.new("RGB", (48, 32), (40, 90, 200))
picture.paste((250, 20, 20), (0, 0, 16, 8))
picture.paste((20, 250, 20), (32, 0, 48, 24))
names = []


def save(name, data):
    with open(name, "wb") as file:
        file.write(data)
    turned = ImageOps.exif_transpose(Image.open(name))
    turned.save(f"{name}-turned.png", exif=b"")
    names.append(name)


def encoded(kind, **options):
    file = io.BytesIO()
    picture.save(file, kind, **options)
    return file.getvalue()


def tiff(orientation, order="<", kind=3, thumbnail=None):
    """A TIFF with one entry, and if asked for with a second directory, that of a thumbnail."""
    data = (b"II*\0" if order == "<" else b"MM\0*") + struct.pack(order + "I", 8)
    values = [orientation] if thumbnail is None else [orientation, thumbnail]
    for number, value in enumerate(values):
        after = 0 if number + 1 == len(values) else 8 + 18
        data += struct.pack(order + "HHHI", 1, 0x0112, kind, 1)
        data += struct.pack(order + {1: "Bxxx", 3: "Hxx", 4: "I"}[kind], value) + struct.pack(order + "I", after)
    return data


def jpeg(*segments):
    data = encoded("JPEG", quality=98, subsampling=0)
    said = b"".join(b"\xff\xe1" + struct.pack(">H", len(s) + 2) + s for s in segments)
    return data[:2] + said + data[2:]


def png(*chunks):
    data = encoded("PNG")
    said = b"".join(
        struct.pack(">I", len(c)) + k + c + struct.pack(">I", zlib.crc32(k + c)) for k, c in chunks
    )
    return data[:33] + said + data[33:]


def profile(exif):
    """Exif data as ImageMagick writes them into a text."""
    digits = exif.hex().encode()
    lines = [digits[at : at + 72] for at in range(0, len(digits), 72)]
    return b"\nexif\n%8d\n" % len(exif) + b"\n".join(lines) + b"\n"


NAME, TEXT = b"Exif\0\0", b"Raw profile type exif\0"
for orientation in range(1, 9):
    exif = Image.Exif()
    exif[0x0112] = orientation
    save(f"{orientation}.jpg", encoded("JPEG", quality=98, subsampling=0, exif=exif))
    save(f"{orientation}.png", encoded("PNG", exif=exif))
for orientation in (5, 6, 8):
    said = tiff(orientation)
    for order in "<>":
        for kind in (3, 4):
            named = f"{orientation}-{kind}-{ord(order)}"
            save(f"{named}.jpg", jpeg(NAME + tiff(orientation, order, kind)))
            save(f"{named}.png", png((b"eXIf", tiff(orientation, order, kind))))
    save(f"{orientation}-first.jpg", jpeg(NAME + said, NAME + tiff(1)))
    save(f"{orientation}-second.jpg", jpeg(NAME + tiff(1), NAME + said))
    save(f"{orientation}-thumbnail.jpg", jpeg(NAME + tiff(1, thumbnail=orientation)))
    save(f"{orientation}-after.jpg", jpeg(b"http://ns.adobe.com/xap/1.0/\0<x/>", NAME + said))
    save(f"{orientation}-named.png", png((b"eXIf", NAME + said)))
    save(f"{orientation}-packed.png", png((b"zTXt", TEXT + b"\0" + zlib.compress(profile(NAME + said)))))
    save(f"{orientation}-text.png", png((b"tEXt", TEXT + profile(NAME + said))))
print(json.dumps(names))
