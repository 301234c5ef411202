#!/usr/bin/env python3
"""Render a volume that fx export has written with Cycles, the path tracer of Blender.

    blender --background --python scripts/blender_volume.py -- IN.vdb OUT.exr --view EX,EY,EZ,TX,TY,TZ,FOV

The medium is that of fx: extinction is the grid "density" [1/m], albedo the grid "Cd" or --albedo, emitted light
the grid "flame" [cd/m3] in the color of a black body of the grid "temperature" [K]. Lengths are meters and +Y is up.
Values of OUT.exr are luminance in units of white, R G B, and opacity A, as those of fx render. Prints one JSON object:
grids, voxel bounds, mean color and opacity, seconds.
"""
import argparse
import json
import math
import sys
import time


def numbers(count):
    def read(text):
        values = [float(word) for word in text.split(",")]
        if len(values) != count or not all(map(math.isfinite, values)):
            raise argparse.ArgumentTypeError(f"'{text}' is not {count} numbers with commas between")
        return values
    return read


def parse(words):
    parser = argparse.ArgumentParser(prog="blender_volume.py", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("input", help="volume (*.vdb)")
    parser.add_argument("output", help="picture (*.exr)")
    parser.add_argument("--view", type=numbers(7), required=True, help="eye and target [m], vertical field of view [degree]")
    parser.add_argument("--size", default="160x120", help="[pixel] WIDTHxHEIGHT (160x120)")
    parser.add_argument("--samples", type=int, default=64, help="paths of a pixel (64)")
    parser.add_argument("--bounces", type=int, default=256, help="most scatterings of a path (256)")
    parser.add_argument("--step", type=float, default=1.0, help="steps of a ray, in Cycles' own steps (1); less is more exact")
    parser.add_argument("--sun-direction", type=numbers(3), default=[0.0, 1.0, 0.0], help="towards the sun")
    parser.add_argument("--sun-illuminance", type=numbers(3), default=[0.0, 0.0, 0.0], help="[lx]")
    parser.add_argument("--sky-luminance", type=numbers(3), default=[0.0, 0.0, 0.0], help="[cd/m2] of the whole sphere")
    parser.add_argument("--exposure", type=float, default=13.0, help="[EV100] (13)")
    parser.add_argument("--albedo", type=float, help="[1] instead of the grid Cd")
    parser.add_argument("--anisotropy", type=float, default=0.0, help="[1] mean cosine g of the phase function")
    parser.add_argument("--density-scale", type=float, default=1.0, help="[1/m] extinction of density 1")
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    return parser.parse_args(words)


def colored(scene_color):
    """A color of Blender, and the strength by which it is multiplied."""
    strength = max(scene_color)
    return [c / strength if strength > 0 else 0.0 for c in scene_color], strength


def build_medium(bpy, arguments, grids, white):
    material = bpy.data.materials.new("medium")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()

    def node(kind, **inputs):
        made = tree.nodes.new(kind)
        for name, value in inputs.items():
            name = name.replace("_", " ")
            if hasattr(value, "links"):
                tree.links.new(value, made.inputs[name])
            else:
                made.inputs[name].default_value = value
        return made

    def grid(name, output="Fac"):
        made = tree.nodes.new("ShaderNodeAttribute")
        made.attribute_name = name
        return made.outputs[output]

    def scaled(value, factor):
        made = tree.nodes.new("ShaderNodeMath")
        made.operation = "MULTIPLY"
        tree.links.new(value, made.inputs[0])
        made.inputs[1].default_value = factor
        return made.outputs[0]

    density = scaled(grid("density"), arguments.density_scale)
    albedo = grid("Cd", "Color") if "Cd" in grids and arguments.albedo is None else None
    even = 0.8 if arguments.albedo is None else arguments.albedo
    color = albedo or (even, even, even, 1.0)
    parts = [node("ShaderNodeVolumeScatter", Density=density, Color=color, Anisotropy=arguments.anisotropy),
             node("ShaderNodeVolumeAbsorption", Density=density, Color=color)]
    if "flame" in grids:
        strength = scaled(grid("flame"), white)
        light = {"Strength": strength}
        if "temperature" in grids:
            light["Color"] = node("ShaderNodeBlackbody", Temperature=grid("temperature")).outputs[0]
        parts.append(node("ShaderNodeEmission", **light))
    while len(parts) > 1:
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(parts.pop().outputs[0], both.inputs[0])
        tree.links.new(parts.pop().outputs[0], both.inputs[1])
        parts.append(both)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(parts[0].outputs[0], output.inputs["Volume"])
    material.cycles.volume_sampling = "MULTIPLE_IMPORTANCE"
    return material


def build_scene(bpy, mathutils, arguments):
    """Blender's axes are those of the file, so that nothing is rotated."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    white = 1.0 / (1.2 * 2.0 ** arguments.exposure)
    bpy.ops.object.volume_import(filepath=arguments.input, align="WORLD", location=(0, 0, 0), rotation=(0, 0, 0))
    volume = bpy.context.object
    if volume is None or not volume.data.grids.load():
        cause = volume.data.grids.error_message if volume else "Blender cannot read it as a volume (*.vdb)"
        sys.exit(f"blender_volume.py: {arguments.input}: {cause}")
    grids = [grid.name for grid in volume.data.grids]
    if "density" not in grids:
        sys.exit(f"blender_volume.py: {arguments.input} has no grid density, but {', '.join(grids)}")
    # Cycles has the value of voxel (i, j, k) at (i, j, k) + 1/2, half a voxel from where OpenVDB has it.
    axes = volume.data.grids["density"].matrix_object
    volume.location = [-0.5 * sum(axes[row][column] for column in range(3)) for row in range(3)]
    volume.data.materials.append(build_medium(bpy, arguments, grids, white))

    eye, target = mathutils.Vector(arguments.view[:3]), mathutils.Vector(arguments.view[3:6])
    back = (eye - target).normalized()
    right = mathutils.Vector((0, 1, 0)).cross(back).normalized()
    if right.length == 0:
        right = mathutils.Vector((1, 0, 0))
    up = back.cross(right)
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle = math.radians(arguments.view[6])
    camera.clip_start, camera.clip_end = 0.01, 1e6
    holder = bpy.data.objects.new("camera", camera)
    holder.matrix_world = mathutils.Matrix((right, up, back)).transposed().to_4x4()
    holder.matrix_world.translation = eye
    bpy.context.collection.objects.link(holder)
    scene = bpy.context.scene
    scene.camera = holder

    color, strength = colored(arguments.sun_illuminance)
    if strength > 0:
        sun = bpy.data.lights.new("sun", "SUN")
        sun.color, sun.energy, sun.angle = color, strength * white, math.radians(0.53)
        holder = bpy.data.objects.new("sun", sun)
        holder.rotation_mode = "QUATERNION"
        holder.rotation_quaternion = mathutils.Vector(arguments.sun_direction).to_track_quat("Z", "Y")
        bpy.context.collection.objects.link(holder)
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    sky, strength = colored(arguments.sky_luminance)
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*sky, 1.0)
    background.inputs["Strength"].default_value = strength * white
    scene.world = world
    return scene, volume, grids


def set_up_render(scene, arguments):
    width, height = (int(word) for word in arguments.size.split("x"))
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    cycles.device = "CPU"
    cycles.samples = arguments.samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.volume_bounces = arguments.bounces
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.volume_step_rate = arguments.step
    cycles.volume_max_steps = 65536
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.film_transparent = True
    render.filepath = arguments.output
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGBA"
    render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Standard"
    if arguments.threads > 0:
        render.threads_mode, render.threads = "FIXED", arguments.threads


def main():
    import bpy
    import mathutils
    arguments = parse(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    scene, volume, grids = build_scene(bpy, mathutils, arguments)
    set_up_render(scene, arguments)
    start = time.monotonic()
    bpy.ops.render.render(write_still=True)
    seconds = time.monotonic() - start
    picture = bpy.data.images.load(arguments.output)
    pixels = list(picture.pixels)
    mean = [sum(pixels[c::4]) / (len(pixels) / 4) for c in range(4)]
    box = [list(corner) for corner in volume.bound_box]
    print(json.dumps({"grids": grids, "low": [min(c[a] for c in box) for a in range(3)],
                      "high": [max(c[a] for c in box) for a in range(3)], "mean": mean[:3], "opacity": mean[3], "seconds": seconds}))


if __name__ == "__main__":
    main()
