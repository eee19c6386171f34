#!/usr/bin/env python3
"""Do other programs read our EXR files as we mean them?

    tests/exr_readers.py CATOPTRA [FOLDER]

CATOPTRA is the program to be tested, FOLDER where the readers are kept (else ~/.cache/catoptra-exr-readers): OpenEXR and Mitsuba of PyPI, in
an environment of their own. Without network it says so and does nothing.

* A picture with every layer, and parts of it, are rendered and read by both.
* Names and kinds of channels, the windows of whole and part, and the texts about names and making are right; parts put together by
  their windows are the whole, bit for bit; Mitsuba sees in every channel the numbers that OpenEXR sees.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

READERS = ["OpenEXR", "mitsuba", "numpy"]
SCENE = """
camera "eye" { eye 0 2 6; target 0 1 0 }
matte "grey" { color 0.5 }
checker "floor" { scale 0.5 }
sphere "größter Ball" material="grey" { center 0 1 0; radius 1 }
plane "ground" material="floor"
rectangle-light "lamp" { corner -1 4 1; edge-u 0 0 -2; edge-v 2 0 0; radiance 9 }
"""
LAYERS = "color,depth,normal,albedo,uv,id,samples,error"
WHOLE = (60, 40)
PARTS = ["0,0,23,40", "23,0,37,17", "23,17,37,23"]
NAMES = {
    "R", "G", "B", "Z", "normal.X", "normal.Y", "normal.Z", "albedo.R", "albedo.G", "albedo.B", "uv.U", "uv.V", "id.entity",
    "id.material", "samples", "error.R", "error.G", "error.B",
}
WHOLE_NUMBERS = {"id.entity", "id.material", "samples"}


def prepare(folder):
    """Installs the readers; an answer says why it cannot."""
    if not (folder / "done").exists():
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        if subprocess.run([folder / "bin/pip", "install", "-q", *READERS]).returncode != 0:
            return "pip has no " + ", ".join(READERS)
        (folder / "done").touch()
    return None


def render(program, folder, name, *more):
    path = folder / name
    options = ["--size", f"{WHOLE[0]}x{WHOLE[1]}", "--samples", "4", "--layers", LAYERS]
    subprocess.run([program, "render", folder / "scene.kdl", "-o", path, *options, *more], check=True)
    return path


def check(program):
    import mitsuba
    import numpy
    import OpenEXR

    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "scene.kdl").write_text(SCENE)
        read = lambda path: OpenEXR.File(str(path), separate_channels=True)
        path = render(program, folder, "whole.exr")
        whole = read(path)
        header, channels = whole.header(), whole.channels()
        assert set(channels) == NAMES, sorted(channels)
        for name, channel in channels.items():
            kind = numpy.uint32 if name in WHOLE_NUMBERS else numpy.float32
            assert channel.pixels.dtype == kind and channel.pixels.shape == WHOLE[::-1], (name, channel.pixels.dtype)
        window = lambda header, name: [[int(n) for n in corner] for corner in header[name]]
        assert window(header, "displayWindow") == [[0, 0], [59, 39]] == window(header, "dataWindow")
        assert "ZIP" in str(header["compression"]), header["compression"]
        about, manifest = json.loads(header["catoptra"]), json.loads(header["manifest"])
        assert about["camera"] == "eye" and about["scene"] == "scene.kdl" and "--layers" in about["command"], about
        assert header["software"] == f"catoptra {about['version']}", header["software"]
        ids = channels["id.entity"].pixels
        seen = {manifest["id.entity"][str(number)] for number in set(ids.flat) - {0}}
        assert seen == {"größter Ball", "ground"}, seen
        pieces = {name: numpy.zeros_like(channel.pixels) for name, channel in channels.items()}
        for number, crop in enumerate(PARTS):
            part = read(render(program, folder, f"part{number}.exr", "--crop", crop))
            (left, top), (right, low) = window(part.header(), "dataWindow")
            assert [left, top, right - left + 1, low - top + 1] == [int(n) for n in crop.split(",")]
            assert window(part.header(), "displayWindow") == [[0, 0], [59, 39]]
            for name, channel in part.channels().items():
                pieces[name][top : low + 1, left : right + 1] = channel.pixels
        for name, channel in channels.items():
            assert pieces[name].tobytes() == channel.pixels.tobytes(), name
        mitsuba.set_variant("scalar_rgb")
        bitmap = mitsuba.Bitmap(str(path))
        numbers, names = numpy.array(bitmap), [field.name for field in bitmap.struct_()]
        assert set(names) == NAMES and numbers.shape == (WHOLE[1], WHOLE[0], len(NAMES)), (names, numbers.shape)
        for at, name in enumerate(names):
            assert numpy.array_equal(numbers[..., at], channels[name].pixels.astype(numpy.float32)), name
        assert bitmap.metadata()["manifest"] == header["manifest"]


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[2] if len(sys.argv) > 2 else Path.home() / ".cache/catoptra-exr-readers")
    if (missing := prepare(folder)) is not None:
        print(f"skipped: {missing}")
        return
    if Path(sys.prefix).resolve() != folder.resolve():
        python = folder / "bin/python"
        sys.exit(subprocess.run([python, __file__, Path(sys.argv[1]).resolve(), folder]).returncode)
    check(sys.argv[1])
    print("OpenEXR and Mitsuba read all of it")


main()
