"""Times `tyndall hdri` beside Blender's Sky Texture: the same size, start of the program included, one run.

    cargo build --release -p tyndall-cli
    V/bin/python benches/hdri_against_blender.py target/release/tyndall

V is a virtual environment of Python 3.11 with `pip install "numpy<2" bpy==5.0.1`. Without the package only Tyndall is
timed. The runs of both alternate; the medians are printed, wall and CPU seconds.
"""

import argparse
import importlib.util
import math
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time


def blender_sky(path, width, threads):
    """Renders Blender's sky with multiple scattering, a sun 60 degrees high and its disc, into an EXR of floats."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples = "CPU", 1
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.render.resolution_x, scene.render.resolution_y = width, width // 2
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Raw"
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    camera = bpy.data.cameras.new("camera")
    camera.type, camera.panorama_type = "PANO", "EQUIRECTANGULAR"
    placed = bpy.data.objects.new("camera", camera)
    placed.rotation_euler = (math.pi / 2, 0, 0)
    scene.collection.objects.link(placed)
    scene.camera = placed
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    sky = nodes.new("ShaderNodeTexSky")
    sky.sky_type, sky.sun_disc = "MULTIPLE_SCATTERING", True
    sky.sun_elevation, sky.sun_rotation = math.radians(60), 0.0
    background, output = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
    links.new(sky.outputs[0], background.inputs["Color"])
    links.new(background.outputs["Background"], output.inputs["Surface"])
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def timed(command):
    """Wall and CPU seconds of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    started = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    wall = time.perf_counter() - started
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    """Runs both in turn and prints a line for each."""
    parser = argparse.ArgumentParser()
    parser.add_argument("tyndall", help="the program tyndall, built with --release")
    parser.add_argument("--width", type=int, default=2048)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--render-blender", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.render_blender:
        blender_sky(options.render_blender, options.width, os.cpu_count() or 1)
        return
    with tempfile.TemporaryDirectory() as folder:
        os.environ["TYNDALL_CACHE_DIR"] = os.path.join(folder, "cache")
        width = ["--width", str(options.width)]
        hdri = [options.tyndall, "hdri", "preset:noon", "-o", os.path.join(folder, "sky.exr"), *width]
        ways = {"tyndall, new tables": [*hdri, "--no-cache"], "tyndall, kept tables": hdri}
        if importlib.util.find_spec("bpy"):
            script = [sys.executable, os.path.abspath(__file__), options.tyndall]
            ways["blender"] = [*script, *width, "--render-blender", os.path.join(folder, "blender.exr")]
        else:
            print("no package bpy: Blender is not timed")
        for command in ways.values():
            timed(command)
        times = {name: [] for name in ways}
        for _ in range(options.runs):
            for name, command in ways.items():
                times[name].append(timed(command))
        size = f"{options.width} x {options.width // 2}"
        print(f"{size} px, start included, {options.runs} runs, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
        for name, runs in times.items():
            wall, cpu = (statistics.median(values) for values in zip(*runs))
            least = min(wall for wall, _ in runs)
            print(f"{name:22} {wall:6.2f} s wall (least {least:.2f}), {cpu:6.2f} CPU-s")


if __name__ == "__main__":
    main()
