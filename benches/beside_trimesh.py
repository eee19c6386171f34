#!/usr/bin/env python3
"""The rays of `casting.rs` and of `tests/tests/caster.rs` by trimesh over Embree, on one thread: how many a second, and how many slip through.

    python3 -m venv beside && beside/bin/pip install trimesh embreex && beside/bin/python benches/beside_trimesh.py
"""
import time

import numpy as np
import trimesh
from trimesh.ray.ray_pyembree import RayMeshIntersector

mesh = trimesh.creation.icosphere(subdivisions=6)
ray = RayMeshIntersector(mesh, scale_to_box=False)
print(len(mesh.faces), "triangles")

random = np.random.default_rng(1)
count = 1_000_000
unit = random.normal(size=(count, 3))
origins = 3 * unit / np.linalg.norm(unit, axis=1, keepdims=True)
directions = random.uniform(-1, 1, (count, 3)) - origins
for call in (ray.intersects_first, ray.intersects_any):
    seconds = []
    for _ in range(5):
        start = time.perf_counter()
        call(origins, directions)
        seconds.append(time.perf_counter() - start)
    print(f"{call.__name__}: {count / min(seconds) / 1e6:.2f} million rays a second")

edges = mesh.vertices[mesh.edges_unique]
share = random.uniform(0, 1, (len(edges), 1))
targets = np.concatenate([mesh.vertices, edges.mean(axis=1), edges[:, 0] * (1 - share) + edges[:, 1] * share])
for eye in np.array([[0, 0, 0], [0.1, -0.2, 0.05]]):
    missed = np.count_nonzero(ray.intersects_first(np.tile(eye, (len(targets), 1)), targets - eye) < 0)
    print(f"{missed} of {len(targets)} rays from {eye} to corners and edges slip through")
