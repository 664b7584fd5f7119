"""Solids by trimesh: closed, and the same in STL and 3MF."""

import trimesh


def checks(out):
    for path in sorted(out.glob("*.stl")):
        stl = trimesh.load(path)
        other = trimesh.load(path.with_suffix(".3mf"), force="mesh")
        for name, mesh in ((path.name, stl), (path.with_suffix(".3mf").name, other)):
            mesh.merge_vertices()
            fine = mesh.is_watertight and mesh.is_winding_consistent and mesh.volume > 0
            yield f"{name}: closed, {mesh.volume:.0f} mm^3, {mesh.extents.round(2).tolist()} mm", None if fine else "open"
        same = abs(stl.volume / other.volume - 1)
        yield f"{path.stem}: one volume", None if same < 1e-5 else f"{same:.2e}"
