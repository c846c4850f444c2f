"""Prints what trimesh reads of a mesh: sizes, bounds, and the colour of the texture at the first and last vertex."""
import json
import sys

import numpy
import trimesh

scene = trimesh.load(sys.argv[1], process=False, force="scene")
result = {}
for node in scene.graph.nodes_geometry:
    place, name = scene.graph[node]
    mesh = scene.geometry[name].copy().apply_transform(place)
    found = {
        "vertices": len(mesh.vertices),
        "faces": len(mesh.faces),
        "bounds": mesh.bounds.tolist(),
        "outward": float((mesh.face_normals * mesh.vertex_normals[mesh.faces[:, 0]]).sum(axis=1).min()),
    }
    uv = getattr(mesh.visual, "uv", None)
    if uv is None:
        data = mesh.metadata.get("_ply_raw", {}).get("vertex", {}).get("data")
        uv = None if data is None else numpy.stack([data["s"], data["t"]], axis=1)
    if uv is not None:
        found["uv"] = [numpy.asarray(uv)[k].tolist() for k in (0, -1)]
        material = getattr(mesh.visual, "material", None)
        image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
        if image is not None:
            inside = numpy.clip(numpy.asarray(uv), 0.01, 0.99)
            colors = trimesh.visual.color.uv_to_color(inside, image)
            found["colors"] = [colors[k][:3].tolist() for k in (0, -1)]
    result[name] = found
print(json.dumps(result))
