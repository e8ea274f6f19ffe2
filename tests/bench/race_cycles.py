"""One picture by Blender's Cycles on one thread, of direct light and one bounce of it, for race.sh:
blender --background --python race_cycles.py -- SCENE.glb OUT.exr SIDE SAMPLES

Every surface is a Lambert reflector of its base colour; emitters shine from their front, in cd/m2, and reflect nothing.
Scenes without textures."""
import json
import math
import struct
import sys
import time

import bpy
import numpy

if not hasattr(numpy, "bool"):
    numpy.bool = bool  # the importer of Blender 3.4 asks for it


def document(path):
    with open(path, "rb") as file:
        file.read(12)
        length, _ = struct.unpack("<II", file.read(8))
        return json.loads(file.read(length))


def set_material(material, description):
    tree = material.node_tree
    tree.nodes.clear()
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    surface = diffuse
    emission = description.get("emissiveFactor", [0, 0, 0])
    if max(emission) > 0:
        strength = description.get("extensions", {}).get("KHR_materials_emissive_strength", {})
        shine = tree.nodes.new("ShaderNodeEmission")
        shine.inputs["Color"].default_value = (*emission, 1)
        shine.inputs["Strength"].default_value = strength.get("emissiveStrength", 1)
        diffuse.inputs["Color"].default_value = (0, 0, 0, 1)
        surface = tree.nodes.new("ShaderNodeMixShader")
        side = tree.nodes.new("ShaderNodeNewGeometry")
        tree.links.new(side.outputs["Backfacing"], surface.inputs[0])
        tree.links.new(shine.outputs[0], surface.inputs[1])
        tree.links.new(diffuse.outputs[0], surface.inputs[2])
    else:
        colour = description["pbrMetallicRoughness"].get("baseColorFactor", [1, 1, 1, 1])
        diffuse.inputs["Color"].default_value = (*colour[:3], 1)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(surface.outputs[0], output.inputs["Surface"])


path, picture, side, samples = sys.argv[sys.argv.index("--") + 1:]
gltf = document(path)
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
bpy.ops.import_scene.gltf(filepath=path)
for description in gltf["materials"]:
    material = bpy.data.materials.get(description["name"])
    if material:
        set_material(material, description)

scene = bpy.context.scene
scene.world.use_nodes = True
scene.world.node_tree.nodes.clear()
camera = bpy.data.objects[next(n["name"] for n in gltf["nodes"] if n.get("camera") == 0)]
if camera.type != "CAMERA":
    camera = next(child for child in camera.children if child.type == "CAMERA")
camera.data.sensor_fit, camera.data.sensor_height = "VERTICAL", 24
camera.data.lens = 12 / math.tan(gltf["cameras"][0]["perspective"]["yfov"] / 2)
scene.camera = camera

scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.device, cycles.samples = "CPU", int(samples)
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.pixel_filter_type, cycles.filter_width = "BOX", 1
cycles.max_bounces = cycles.diffuse_bounces = 1
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
scene.render.threads_mode, scene.render.threads = "FIXED", 1
scene.render.resolution_x = scene.render.resolution_y = int(side)
scene.render.resolution_percentage = 100
image = scene.render.image_settings
image.file_format, image.color_depth, image.color_mode = "OPEN_EXR", "32", "RGB"
scene.render.filepath = picture
start = time.time()
bpy.ops.render.render(write_still=True)
print(f"rendered in {time.time() - start:.1f} s")
