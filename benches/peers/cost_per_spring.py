#!/usr/bin/env python3
"""The time of a whole step of the published method for each spring, from 50 x 50 to 2048 x 2048 points, as a picture.

    cargo build --release && python3 benches/peers/cost_per_spring.py docs/media/cost-per-spring.svg

The cloth of scenes/pinned2.json falls from its start; its thickness and its step shrink with the distance of its points.
The size and the number of threads change from run to run, and each point of the picture is the least of all rounds. The
numbers are printed as a table, too, and --numbers TABLE draws one that was printed before.
"""

import argparse
import json
import math
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIDES = [50, 70, 100, 140, 200, 280, 400, 560, 800, 1024, 1448, 2048]
COLOURS = {1: "#1b6ca8", 2: "#c8553d"}


def nanoseconds(program, side, threads):
    """ns a step and spring."""
    # About two million point steps, in steps as long for their points' distance as the report's.
    steps = max(8, min(2_000_000 // (side * side), 600))
    settings = {
        "cloth.num_width_points": side,
        "cloth.num_height_points": side,
        "cloth.pinned": [[0, 0], [side - 1, 0]],
        "cloth.thickness": 0.0095 * 50 / side,
        "sim.steps_per_frame": steps,
        "sim.fps": 2700.0 * side / 50 / steps,
    }
    command = [program, "simulate", ROOT / "scenes/pinned2.json", "--bench", "--allow-unstable"]
    command += ["--frames", "1", "--threads", str(threads)]
    for key, value in settings.items():
        command += ["--set", f"{key}={json.dumps(value)}"]
    run = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return run["ns_per_substep"] / run["springs"]


def measure(program, rounds):
    best = {}
    for _ in range(rounds):
        for side in SIDES:
            for threads in COLOURS:
                key = (side, threads)
                best[key] = min(best.get(key, math.inf), nanoseconds(program, side, threads))
    return best


def table(best):
    lines = ["| points a side | 1 thread | 2 threads |", "|--:|--:|--:|"]
    lines += [f"| {side} | {best[side, 1]:.2f} | {best[side, 2]:.2f} |" for side in SIDES]
    return "\n".join(lines)


def read(path):
    rows = [line.strip("| \n").split(" | ") for line in open(path) if line.startswith("| ") and "thread" not in line]
    return {(int(side), threads): float(ns) for side, *cells in rows for threads, ns in zip(COLOURS, cells)}


def svg(best):
    most = math.ceil(max(best.values()))
    left, top, width, height = 48, 16, 560, 260
    across = lambda side: left + width * math.log(side / 50) / math.log(2048 / 50)
    down = lambda ns: top + height * (1 - ns / most)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 330" font-family="sans-serif" font-size="12">',
             '<rect width="640" height="330" fill="#fff"/>']
    for ns in range(0, most + 1, max(1, most // 6)):
        parts.append(f'<path d="M{left} {down(ns):.1f}h{width}" stroke="#ddd"/>')
        parts.append(f'<text x="{left - 6}" y="{down(ns) + 4:.1f}" text-anchor="end">{ns}</text>')
    for side in [50, 100, 200, 400, 800, 2048]:
        parts.append(f'<text x="{across(side):.1f}" y="{top + height + 18}" text-anchor="middle">{side}²</text>')
    for threads, colour in COLOURS.items():
        points = " ".join(f"{across(side):.1f},{down(best[side, threads]):.1f}" for side in SIDES)
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
        for side in SIDES:
            parts.append(f'<circle cx="{across(side):.1f}" cy="{down(best[side, threads]):.1f}" r="3" fill="{colour}"/>')
        label = "1 thread" if threads == 1 else f"{threads} threads"
        parts.append(f'<text x="{left + 12}" y="{top + height - 34 + 16 * threads}" fill="{colour}">{label}</text>')
    parts.append(f'<text x="{left + width / 2}" y="{top + height + 38}" text-anchor="middle">points</text>')
    parts.append(f'<text transform="translate(14 {top + height / 2}) rotate(-90)" text-anchor="middle">ns a step and spring</text>')
    return "\n".join(parts) + "\n</svg>\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("svg", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--drape", default=ROOT / "target/release/drape", help="the program")
    parser.add_argument("--numbers", help="a table that was printed before")
    options = parser.parse_args()
    best = read(options.numbers) if options.numbers else measure(options.drape, options.rounds)
    print(table(best))
    options.svg.write_text(svg(best), encoding="utf-8")


if __name__ == "__main__":
    main()
