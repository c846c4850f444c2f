"""Prints the heights of the vertices of a cloth that Blender imports, at the first and at the last frame."""
import json
import sys

try:
    import bpy
except ImportError:
    print(json.dumps(None))
    sys.exit()

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = 90
bpy.ops.import_scene.gltf(filepath=sys.argv[1])
cloth = next(o for o in bpy.data.objects if o.type == "MESH" and o.name.startswith("cloth"))
last = int(sys.argv[2])
heights = []
for frame in (0, last):
    bpy.context.scene.frame_set(frame)
    shape = cloth.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    heights.append(sorted((cloth.matrix_world @ v.co).z for v in shape.vertices))
print(json.dumps({"heights": heights, "uv": [list(cloth.data.uv_layers[0].uv[k].vector) for k in (0, -1)]}))
