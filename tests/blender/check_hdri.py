"""What Blender makes of a file of `tyndall hdri`: where the sun is, how bright a grey plane gets, what its numbers mean.

    python check_hdri.py SKY.exr           with the disc: sun, units, light of the plane
    python check_hdri.py SKY.exr --lamp    without the disc: the lamp of the sidecar lights the plane with the sky

Needs Python 3.11 with the package bpy (5.0.1). Prints one JSON object.
"""

import argparse
import json
import math
import os
import sys
import tempfile

import bpy
import numpy as np

ALBEDO = 0.1


def load_pixels(path):
    """Pixels as Blender hands them to shaders, row 0 on top."""
    image = bpy.data.images.load(os.path.abspath(path), check_existing=False)
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)[::-1, :, :3].astype(np.float64)
    bpy.data.images.remove(image)
    return pixels


def directions(width, height):
    """Unit vectors of all pixels and their solid angles, by Blender's mapping of environment textures."""
    turn = 2 * math.pi * ((np.arange(width) + 0.5) / width - 0.5)
    edges = np.sin(math.pi * (0.5 - np.arange(height + 1) / height))
    elevation = math.pi * (0.5 - (np.arange(height) + 0.5) / height)
    x = np.cos(elevation)[:, None] * np.cos(turn)
    y = -np.cos(elevation)[:, None] * np.sin(turn)
    z = np.sin(elevation)[:, None] * np.ones(width)
    solid = (edges[:-1] - edges[1:])[:, None] * (2 * math.pi / width) * np.ones(width)
    return np.stack([x, y, z], -1), solid


def render(setup, width, height, samples):
    """Renders a scene in linear light without any display transform."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.seed = "CPU", samples, 1
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Raw"
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    setup(scene)
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "render.exr")
        bpy.ops.render.render(write_still=True)
        return load_pixels(scene.render.filepath)


def add_world(scene, path):
    """The file as the world, as a user adds it: an Environment Texture and nothing else."""
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    texture = nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(os.path.abspath(path))
    background = nodes.new("ShaderNodeBackground")
    output = nodes.new("ShaderNodeOutputWorld")
    links.new(texture.outputs["Color"], background.inputs["Color"])
    links.new(background.outputs["Background"], output.inputs["Surface"])
    world.cycles.sampling_method = "MANUAL"
    # At the width of the file a lobe of the disc's light is sampled so seldom that a picture lacks 4 % of it.
    world.cycles.sample_map_resolution = 2 * texture.image.size[0]


def add_lamp(scene, lamp):
    """The lamp of the sidecar."""
    light = bpy.data.lights.new("sun", "SUN")
    light.energy, light.color = lamp["strength"], lamp["color"]
    light.angle = math.radians(lamp["angle_deg"])
    sun = bpy.data.objects.new("sun", light)
    sun.rotation_euler = [math.radians(angle) for angle in lamp["rotation_euler_xyz_deg"]]
    scene.collection.objects.link(sun)


def add_camera(scene, kind, location, rotation):
    """A camera of a kind, PERSP, ORTHO or PANO."""
    camera = bpy.data.cameras.new("camera")
    camera.type = kind
    if kind == "PANO":
        camera.panorama_type = "EQUIRECTANGULAR"
    if kind == "ORTHO":
        camera.ortho_scale = 0.5
    placed = bpy.data.objects.new("camera", camera)
    placed.location, placed.rotation_euler = location, rotation
    scene.collection.objects.link(placed)
    scene.camera = placed


def add_plane(scene):
    """A level grey plane."""
    bpy.ops.mesh.primitive_plane_add(size=2)
    material = bpy.data.materials.new("grey")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (ALBEDO, ALBEDO, ALBEDO, 1)
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    bpy.context.object.data.materials.append(material)


def sun_seen(path, size):
    """Direction of the brightest light in a panorama that Blender renders of the world, by its own camera."""
    width, height = size

    def setup(scene):
        add_world(scene, path)
        # Looks along +y with z up.
        add_camera(scene, "PANO", (0, 0, 0), (math.pi / 2, 0, 0))

    picture = render(setup, width, height, 4).sum(-1)
    weights = np.where(picture > 0.01 * picture.max(), picture, 0.0)
    seen, solid = directions(width, height)
    # The centre of this picture is +y where that of the file is +x.
    seen = np.stack([-seen[..., 1], seen[..., 0], seen[..., 2]], -1)
    centre = (seen * (weights * solid)[..., None]).sum((0, 1))
    return centre / np.linalg.norm(centre)


def plane_light(path, lamp, samples):
    """Mean radiance of the grey plane, seen from above."""

    def setup(scene):
        add_world(scene, path)
        add_plane(scene)
        if lamp:
            add_lamp(scene, lamp)
        add_camera(scene, "ORTHO", (0, 0, 1), (0, 0, 0))

    return render(setup, 32, 32, samples).mean((0, 1))


def main():
    """Prints what Blender sees beside what is expected."""
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("--lamp", action="store_true")
    parser.add_argument("--samples", type=int, default=1024)
    options = parser.parse_args()
    with open(os.path.splitext(options.file)[0] + ".json", encoding="utf-8") as file:
        sidecar = json.load(file)
    sun = sidecar["sun"]
    pixels = load_pixels(options.file)
    height, width, _ = pixels.shape
    seen, solid = directions(width, height)
    cosine = np.clip(seen[..., 2], 0, None)
    irradiance = (pixels * (solid * cosine)[..., None]).sum((0, 1))
    lamp = sun["blender_lamp"] if options.lamp else None
    if lamp:
        irradiance += np.array(sun["normal_irradiance"]) * sun["direction_east_north_up"][2]
    found = plane_light(options.file, lamp, options.samples)
    expected = ALBEDO * irradiance / math.pi
    result = {
        "blender": bpy.app.version_string,
        "size_px": [width, height],
        "plane": found.tolist(),
        "plane_expected": expected.tolist(),
        "plane_error": float(np.abs(found / expected - 1).max()),
        "zenith_cd_m2": float(pixels[0].mean(0) @ [0.2126729, 0.7151522, 0.072175])
        * sidecar["unit"]["white_luminance_cd_m2"],
    }
    if sun["in_picture"]:
        apart = np.linalg.norm(sun_seen(options.file, (width, height)) - np.array(sun["direction_east_north_up"]))
        result["sun_error_px"] = float(apart * width / (2 * math.pi))
    print("RESULT " + json.dumps(result))


if __name__ == "__main__":
    sys.exit(main())
