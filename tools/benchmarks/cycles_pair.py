#!/usr/bin/env python3
"""Times the golden under an image against Blender's Cycles at equal error, in pairs: one sphere, one sky, cloth under lacquer in both.

    tools/benchmarks/cycles_pair.py --environment sky.hdr [--error 0.01] [--pairs 3]

Each program is held to a long run of its own (their materials are alike, not the same), over the pixels well inside the sphere's outline:
the error is the root mean square of what a channel is off, relative to it. Cycles' directions a pixel are chosen so that both errors are near
each other, and its time is scaled by the square of the ratio that is left. Both times are of the processor, user and system, of all threads:
of ours from start to end with bounds, of Cycles of the rendering alone.
"""
import argparse
import array
import json
import math
import os
import pathlib
import resource
import shutil
import struct
import subprocess
import sys
import tempfile

FIELD_OF_VIEW = 0.7
DISTANCE = 3.2
MATERIAL = {"color": [0.5, 0.2, 0.1], "roughness": 0.5, "sheen_roughness": 0.4, "clearcoat_roughness": 0.1}

# Runs inside Blender.
CYCLES = """
import bpy, json, resource, sys, array
p = json.loads(sys.argv[-1])
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48)
sphere = bpy.context.object
bpy.ops.object.shade_smooth()
material = bpy.data.materials.new('cloth')
material.use_nodes = True
inputs = material.node_tree.nodes['Principled BSDF'].inputs
inputs['Base Color'].default_value = p['color'] + [1]
inputs['Roughness'].default_value = p['roughness']
inputs['Sheen'].default_value = 1
inputs['Clearcoat'].default_value = 1
inputs['Clearcoat Roughness'].default_value = p['clearcoat_roughness']
sphere.data.materials.append(material)
camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
camera.data.sensor_fit = 'VERTICAL'
camera.data.angle = p['field_of_view']
camera.location = (0, -p['distance'], 0)
camera.rotation_euler = (1.5707963267948966, 0, 0)
scene.collection.objects.link(camera)
scene.camera = camera
world = bpy.data.worlds.new('sky')
scene.world = world
world.use_nodes = True
sky = world.node_tree.nodes.new('ShaderNodeTexEnvironment')
sky.image = bpy.data.images.load(p['environment'])
world.node_tree.links.new(sky.outputs['Color'], world.node_tree.nodes['Background'].inputs['Color'])
scene.render.engine = 'CYCLES'
scene.cycles.device = 'CPU'
scene.cycles.use_denoising = False
scene.cycles.use_adaptive_sampling = False
scene.cycles.sample_clamp_indirect = 0
scene.cycles.pixel_filter_type = 'BOX'
scene.cycles.filter_width = 1
scene.render.film_transparent = True
scene.render.resolution_x = scene.render.resolution_y = p['size']
scene.render.image_settings.file_format = 'OPEN_EXR'
scene.render.image_settings.color_mode = 'RGBA'
scene.render.image_settings.color_depth = '32'
scene.render.filepath = p['output'] + '.exr'
scene.cycles.samples = p['samples']
scene.cycles.seed = p['seed']
before = resource.getrusage(resource.RUSAGE_SELF)
bpy.ops.render.render(write_still=True)
after = resource.getrusage(resource.RUSAGE_SELF)
pixels = array.array('f', bpy.data.images.load(scene.render.filepath).pixels[:])
with open(p['output'], 'wb') as out:
    pixels.tofile(out)
print('SECONDS', after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
"""


def write_sphere(path):
    """The sphere of Blender's UV sphere, its camera and the material, as glTF."""
    columns, rows = 96, 48
    points, indices = [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            theta, phi = math.pi * j / rows, 2 * math.pi * i / columns
            points.append((math.sin(theta) * math.cos(phi), math.cos(theta), -math.sin(theta) * math.sin(phi)))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b = a + columns + 1
            indices += [a, b, a + 1, a + 1, b, b + 1]
    data = b"".join(struct.pack("<3f", *p) for p in points)
    data_indices = struct.pack("<%dI" % len(indices), *indices)
    gltf = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_sheen", "KHR_materials_clearcoat"],
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, DISTANCE]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": FIELD_OF_VIEW, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1, "material": 0}]}],
        "materials": [{
            "pbrMetallicRoughness": {"baseColorFactor": MATERIAL["color"] + [1], "metallicFactor": 0, "roughnessFactor": MATERIAL["roughness"]},
            "extensions": {
                "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": MATERIAL["sheen_roughness"]},
                "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": MATERIAL["clearcoat_roughness"]},
            },
        }],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
            {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(data)},
                        {"buffer": 0, "byteOffset": len(data), "byteLength": len(data_indices)}],
        "buffers": [{"byteLength": len(data) + len(data_indices)}],
    }
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    data += data_indices
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)) + struct.pack("<I4s", len(text), b"JSON") + text +
                     struct.pack("<I4s", len(data), b"BIN\0") + data)


def run(command):
    """Processor seconds of a child and what it printed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit("%s: exit code %d\n%s" % (command[0], done.returncode, done.stderr))
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


class Golden:
    name = "golden"

    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.scene = folder / "sphere.glb"
        write_sphere(self.scene)

    def draw(self, error, seed):
        """Seconds and pixels, RGB, rows from the bottom."""
        out = self.folder / "golden.pfm"
        size = str(self.options.size)
        seconds, _ = run([self.options.program, "golden", str(self.scene), "-o", str(out), "--environment", self.options.environment,
                          "--width", size, "--height", size, "--error", str(error), "--seed", str(seed)])
        content = out.read_bytes()
        header = content.split(b"\n", 3)
        pixels = array.array("f", header[3])
        if (float(header[2]) < 0) != (sys.byteorder == "little"):
            pixels.byteswap()
        return seconds, [pixels[i:i + 3] for i in range(0, len(pixels), 3)]


class Cycles:
    name = "cycles"

    def __init__(self, options, folder):
        self.options, self.folder = options, folder

    def draw(self, samples, seed):
        out = self.folder / "cycles.raw"
        task = dict(MATERIAL, environment=os.path.abspath(self.options.environment), output=str(out), samples=samples, seed=seed,
                    size=self.options.size, field_of_view=FIELD_OF_VIEW, distance=DISTANCE)
        _, text = run([self.options.blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python-expr", CYCLES, "--",
                       json.dumps(task)])
        seconds = [float(line.split()[1]) for line in text.splitlines() if line.startswith("SECONDS")][-1]
        pixels = array.array("f", out.read_bytes())
        return seconds, [pixels[i:i + 3] for i in range(0, len(pixels), 4)]


def inside(size):
    """Pixels whose neighbourhood lies on the sphere: no edge is smoothed there."""
    outline = math.tan(math.asin(1 / DISTANCE)) / math.tan(FIELD_OF_VIEW / 2) * size / 2
    return [y * size + x for y in range(size) for x in range(size)
            if math.hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) < 0.98 * outline - 1]


def error(pixels, truth, where):
    """Root mean square of the relative error, over channels, and its 99th percentile."""
    off = [abs(pixels[i][c] - truth[i][c]) / max(truth[i][c], 1e-3) for i in where for c in range(3)]
    off.sort()
    return math.sqrt(sum(e * e for e in off) / len(off)), off[int(0.99 * len(off))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--environment", required=True)
    parser.add_argument("--error", type=float, default=0.01, help="what the golden is asked for")
    parser.add_argument("--pairs", type=int, default=3)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--reference-samples", type=int, default=16384, help="directions a pixel of Cycles' long run")
    parser.add_argument("--program", default=str(pathlib.Path(__file__).resolve().parents[2] / "build/release/sheen-cts"))
    parser.add_argument("--blender", default="blender")
    options = parser.parse_args()
    if shutil.which(options.blender) is None:
        sys.exit("%s is not installed" % options.blender)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        golden, cycles = Golden(options, folder), Cycles(options, folder)
        where = inside(options.size)
        seconds, golden_truth = golden.draw(options.error / 8, 1000)
        print("golden: long run %.1f s" % seconds, flush=True)
        seconds, cycles_truth = cycles.draw(options.reference_samples, 1000)
        print("cycles: long run %.1f s" % seconds, flush=True)
        samples, ratios = 64, []
        for pair in range(options.pairs):
            ours, pixels = golden.draw(options.error, pair)
            goal, goal99 = error(pixels, golden_truth, where)
            print("pair %d  golden: %.2f s, rms error %.5f, 99th percentile %.5f" % (pair, ours, goal, goal99), flush=True)
            while True:
                theirs, pixels = cycles.draw(samples, pair)
                reached, reached99 = error(pixels, cycles_truth, where)
                print("        cycles: %.2f s, rms error %.5f, 99th percentile %.5f, %d samples" % (theirs, reached, reached99, samples), flush=True)
                ratio = reached / goal
                if ratio < 1.4 or samples * 4 >= options.reference_samples:
                    break
                samples = min(int(samples * ratio * ratio) + 1, options.reference_samples // 4)
            ratios.append(theirs * ratio * ratio / ours)
            print("        at equal error Cycles takes %.1f times as long" % ratios[-1], flush=True)
        print("median of %d pairs: %.1f" % (len(ratios), sorted(ratios)[len(ratios) // 2]))


if __name__ == "__main__":
    main()
