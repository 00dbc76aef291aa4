#!/usr/bin/env python3
"""Compares models as Rayline imports them with how an independent reader, trimesh, does.

    pip install trimesh
    python3 tests/judges/compare_imports.py FILE_OR_FOLDER ...

For each .obj, .gltf and .glb file, `rayline convert` writes the scene as RON. The surface and the bounds of
all its meshes must be those that trimesh finds, but for 0.1 % of the model's size. Models that Rayline moves
or shrinks, because they lie far away, are compared by their surface over the square of their size.
Differences are printed, also where Rayline is right: trimesh leaves out skins and morph targets, which
Rayline draws at rest, and cuts hollow faces as fans.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import trimesh

ROOT = Path(__file__).resolve().parents[2]
RAYLINE = ["cargo", "run", "--quiet", "--release", "--manifest-path", str(ROOT / "Cargo.toml"), "--"]
NUMBER = re.compile(r"-?\d[\d.e+-]*")


def numbers(text, name, width):
    """The rows of the list `name` of each mesh in RON."""
    lists = re.findall(rf"\b{name}: (?:Some\()?\[(.*?)\]", text, re.DOTALL)
    return [np.array(NUMBER.findall(found), dtype=float).reshape(-1, width) for found in lists]


def turned(x, y, z):
    """The rotation about the x axis, then about y, then about z."""
    matrix = np.eye(3)
    for axis, angle in enumerate((x, y, z)):
        (a, b), turn = [i for i in range(3) if i != axis], np.eye(3)
        sine = np.sin(angle) if axis != 1 else -np.sin(angle)
        turn[a, a] = turn[b, b] = np.cos(angle)
        turn[a, b], turn[b, a] = -sine, sine
        matrix = turn @ matrix
    return matrix


def of_rayline(file, folder):
    """The triangles of all meshes of the imported scene: corners by coordinates."""
    ron = Path(folder) / "scene.ron"
    run = subprocess.run([*RAYLINE, "convert", file, ron], capture_output=True, text=True)
    if run.returncode != 0:
        return None, run.stderr.strip().splitlines()[-1]
    triangles = []
    # Each object begins with its shape.
    for shape in re.split(r"\bshape: ", ron.read_text())[1:]:
        of_mesh = zip(numbers(shape, "vertices", 3), numbers(shape, "triangles", 3))
        poses = re.findall(r"origin: \((.*?)\),\s*rotation: \((.*?)\)", shape, re.DOTALL)
        size = float(re.search(r"\bsize: ([\d.e+-]+)", shape)[1]) if shape.startswith("Instances") else 1.0
        for vertices, corners in of_mesh:
            model = vertices[corners.astype(int)]
            if not shape.startswith("Instances"):
                triangles.append(model)
            for origin, rotation in poses if shape.startswith("Instances") else []:
                turn = turned(*map(float, rotation.split(",")))
                triangles.append(model * size @ turn.T + np.array(origin.split(","), dtype=float))
    return np.concatenate(triangles) if triangles else None, run.stderr


def of_trimesh(file):
    scene = trimesh.load_scene(file, process=False)
    meshes = [mesh for mesh in scene.dump() if hasattr(mesh, "faces")]
    return np.concatenate([mesh.vertices[mesh.faces] for mesh in meshes]) if meshes else None


def measure(triangles):
    ab, ac = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    surface = np.linalg.norm(np.cross(ab, ac), axis=1).sum() / 2
    points = triangles.reshape(-1, 3)
    return surface, points.min(axis=0), points.max(axis=0)


def difference(file):
    """The reason why a file differs, or None."""
    with tempfile.TemporaryDirectory() as folder:
        ours, said = of_rayline(file, folder)
    try:
        theirs = of_trimesh(file)
    except Exception as error:  # any reader's error
        return f"trimesh cannot read it ({error}); Rayline: {said if ours is None else 'drawn'}"
    if ours is None or theirs is None:
        return f"Rayline: {said}" if ours is None else "Rayline: drawn; trimesh: nothing"
    (surface, low, high), (their_surface, their_low, their_high) = measure(ours), measure(theirs)
    size, their_size = np.linalg.norm(high - low), np.linalg.norm(their_high - their_low)
    if abs(surface / size**2 - their_surface / their_size**2) > 1e-3:
        return f"a surface of {surface:.6g}, trimesh {their_surface:.6g}"
    off = max(np.abs(low - their_low).max(), np.abs(high - their_high).max())
    if off > 1e-3 * their_size and "moved by" not in said:
        return f"from {low} to {high}, trimesh from {their_low} to {their_high}"
    return None


def main():
    files = []
    for path in map(Path, sys.argv[1:]):
        files += sorted(path.rglob("*")) if path.is_dir() else [path]
    files = [file for file in files if file.suffix.lower() in (".obj", ".gltf", ".glb")]
    if not files:
        sys.exit(__doc__)
    alike = 0
    for file in files:
        reason = difference(file)
        alike += reason is None
        if reason:
            print(f"{file}: {reason}")
    print(f"{alike} of {len(files)} files are alike")


main()
