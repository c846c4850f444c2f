#!/usr/bin/env python3
"""Springs and Verlet's scheme alone, in binary64, next to Taichi and NVIDIA Warp on the CPU.

    python3 -m venv peers && peers/bin/pip install taichi==1.7.4 warp-lang==1.19.0
    cargo build --release
    peers/bin/python benches/peers/forces.py            # options: --sides 50,256 --rounds 5

All three take the cloth of scenes/pinned2.json without self-collision and stretch limit, at a step at which it is
stable. Each program runs in a process of its own for each size and number of threads; they take turns, and the table has
the least µs a step of all rounds. The first
line says how far the positions of the two peers differ after a run.

The peers are written as their manuals write cloth: a thread for each point, which visits its twelve springs. So each
spring is computed twice, once for each end, where drape computes it once. Warp runs a kernel on one thread of a CPU.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
OFFSETS = [(-1, 0, 1.0), (0, -1, 1.0), (-1, -1, 1.0), (1, -1, 1.0), (-2, 0, 0.2), (0, -2, 0.2)]
OFFSETS += [(-i, -j, k) for i, j, k in OFFSETS]
KS, DENSITY, DAMPING = 5000.0, 150.0, 0.2


def steps_per_second(side):
    """The report's 2700 for 50 points a side, and more for lighter points."""
    return 2700 * -(-side // 50)


def steps(side):
    """Steps of a run: some tens of milliseconds at least."""
    return max(20, 4_000_000 // (side * side))


def numbers(side):
    mass = DENSITY / side / side
    dt = 1.0 / steps_per_second(side)
    return mass, dt * dt / mass, 1.0 - DAMPING / 100.0


def start(side):
    import numpy

    u = numpy.arange(side) / (side - 1)
    x = numpy.ones((side, side, 3))
    x[:, :, 0], x[:, :, 2] = u[None, :], u[:, None]
    return x


def timed(step, finish, side):
    """Least seconds a step of three runs after the first, all from the state that the last one left."""
    runs = []
    for _ in range(4):
        begin = time.perf_counter()
        for _ in range(steps(side)):
            step()
        finish()
        runs.append((time.perf_counter() - begin) / steps(side))
    return min(runs[1:])


def taichi(side, threads):
    import taichi as ti

    ti.init(arch=ti.cpu, cpu_max_num_threads=threads, default_fp=ti.f64, log_level=ti.ERROR, offline_cache=False)
    mass, dt2_over_m, keep = numbers(side)
    x, last = (ti.Vector.field(3, ti.f64, (side, side)) for _ in range(2))
    x.from_numpy(start(side))
    last.from_numpy(start(side))

    @ti.kernel
    def move(x: ti.template(), last: ti.template()):
        for j, i in x:
            force = ti.Vector([0.0, -9.8 * mass, 0.0])
            for di, dj, k in ti.static(OFFSETS):
                if 0 <= i + di < side and 0 <= j + dj < side:
                    e = x[j + dj, i + di] - x[j, i]
                    l = e.norm()
                    rest = ti.static((di * di + dj * dj) ** 0.5 / (side - 1))
                    force += e * (KS * k * (l - rest) / l)
            if not (j == 0 and (i == 0 or i == side - 1)):
                # Only this point reads its last position, and the two fields change places after the step.
                last[j, i] = x[j, i] + (x[j, i] - last[j, i]) * keep + force * dt2_over_m

    fields = [x, last]

    def step():
        move(*fields)
        fields.reverse()

    return timed(step, ti.sync, side), fields[0].to_numpy()


def warp(side, _threads):
    import warp as wp

    wp.config.quiet = True
    wp.init()
    mass, dt2_over_m, keep = numbers(side)
    offsets = wp.array([(i, j) for i, j, _ in OFFSETS], dtype=wp.vec2i, device="cpu")
    springs = [((i * i + j * j) ** 0.5 / (side - 1), KS * k) for i, j, k in OFFSETS]
    springs = wp.array(springs, dtype=wp.vec2d, device="cpu")

    @wp.kernel
    def move(
        x: wp.array2d(dtype=wp.vec3d),
        last: wp.array2d(dtype=wp.vec3d),
        offsets: wp.array(dtype=wp.vec2i),
        springs: wp.array(dtype=wp.vec2d),
        weight: wp.float64,
        dt2_over_m: wp.float64,
        keep: wp.float64,
    ):
        j, i = wp.tid()
        n = x.shape[0]
        force = wp.vec3d(wp.float64(0.0), weight, wp.float64(0.0))
        for s in range(12):
            a, b = i + offsets[s][0], j + offsets[s][1]
            if a >= 0 and a < n and b >= 0 and b < n:
                e = x[b, a] - x[j, i]
                l = wp.length(e)
                force += e * (springs[s][1] * (l - springs[s][0]) / l)
        if not (j == 0 and (i == 0 or i == n - 1)):
            last[j, i] = x[j, i] + (x[j, i] - last[j, i]) * keep + force * dt2_over_m

    fields = [wp.array(start(side), dtype=wp.vec3d, device="cpu") for _ in range(2)]
    rest = [offsets, springs, -9.8 * mass, dt2_over_m, keep]

    def step():
        wp.launch(move, dim=(side, side), inputs=fields + rest, device="cpu")
        fields.reverse()

    return timed(step, lambda: wp.synchronize_device("cpu"), side), fields[0].numpy()


def drape(program, side, threads):
    """Seconds a step, of three runs the least."""
    settings = {
        "cloth.num_width_points": side,
        "cloth.num_height_points": side,
        "cloth.pinned": [[0, 0], [side - 1, 0]],
        "sim.self_collision": "off",
        "sim.stretch_limit": None,
        "sim.steps_per_frame": steps(side),
        "sim.fps": steps_per_second(side) / steps(side),
    }
    command = [program, "simulate", ROOT / "scenes/pinned2.json", "--bench", "--allow-unstable"]
    command += ["--threads", str(threads), "--frames", "1"]
    for key, value in settings.items():
        command += ["--set", f"{key}={json.dumps(value)}"]
    runs = [json.loads(subprocess.run(command, check=True, capture_output=True).stdout) for _ in range(3)]
    return min(run["ns_per_substep"] for run in runs) * 1e-9


PEERS = {"taichi": taichi, "warp": warp}


def one(name, side, threads, program):
    """A run in a process of its own: seconds a step."""
    if name == "drape":
        return drape(program, side, threads)
    command = [sys.executable, __file__, "--one", name, str(side), str(threads)]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()[-1])


def check(side=50):
    """The largest difference, in metres, between the peers' positions after as many steps."""
    ends = [subprocess.run([sys.executable, __file__, "--positions", name, str(side)], check=True, capture_output=True)
            for name in PEERS]
    import numpy

    first, second = (numpy.frombuffer(end.stdout[-side * side * 24:]) for end in ends)
    return abs(first - second).max()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--sides", default="50,256,1024")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--drape", default=ROOT / "target/release/drape", help="the program")
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    parser.add_argument("--positions", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        name, side, threads = options.one
        print(PEERS[name](int(side), int(threads))[0])
        return
    if options.positions:
        name, side = options.positions
        sys.stdout.flush()
        os.write(1, PEERS[name](int(side), 1)[1].astype("float64").tobytes())
        return
    print(f"Taichi and Warp end at most {check():.1e} m apart.\n")
    print("| points a side | threads | drape | Taichi | Warp |\n|---|--:|--:|--:|--:|")
    for side in map(int, options.sides.split(",")):
        for threads in [1, 2]:
            names = ["drape", "taichi"] + (["warp"] if threads == 1 else [])
            best = dict.fromkeys(names, float("inf"))
            for _ in range(options.rounds):
                for name in names:
                    best[name] = min(best[name], one(name, side, threads, options.drape))
            cells = [f"{best[name] * 1e6:.1f}" if name in best else "–" for name in ["drape", "taichi", "warp"]]
            print(f"| {side} | {threads} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
