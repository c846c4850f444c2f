// The published method as straightforward C++, for `docs/speed.md`: triples, a list of springs, a map of boxes.
//
//     g++ -O3 -march=native -ffp-contract=off -o straightforward benches/peers/straightforward.cpp
//     ./straightforward pinned2          # or selfCollision
//
// It moves the stock scene for a second, prints µs a step (the least of 21 frames), and a hash of the state after the last,
// which `drape simulate scenes/NAME.json --hash --frames 111` prints too.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <unordered_map>
#include <vector>

struct V {
    double x, y, z;
};
static V operator+(V a, V b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
static V operator-(V a, V b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
static V operator*(V a, double s) { return {a.x * s, a.y * s, a.z * s}; }
static double dot(V a, V b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static double length(V a) { return std::sqrt(dot(a, a)); }

static uint64_t splitmix64(uint64_t x) {
    x += 0x9E3779B97F4A7C15;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
    return x ^ (x >> 31);
}

struct Spring {
    int a, b;
    double k, rest;
};

const int W = 50, H = 50, T = 30;
const double ks = 5000, thickness = 0.0095, friction = 0.5;
const double mass = 1.0 * 1.0 * 150 / W / H, dt = 1.0 / 90 / T, a2 = dt * dt / mass, keep = 1 - 0.2 / 100;

static std::vector<V> x, last, force;
static std::vector<bool> pinned;
static std::vector<Spring> springs;
static bool floor_below;

static void start(bool upright) {
    for (int j = 0; j < H; j++)
        for (int i = 0; i < W; i++) {
            double u = 1.0 * i / (W - 1), v = 1.0 * j / (H - 1);
            double r = (splitmix64(j * W + i) >> 11) * (1.0 / 9007199254740992.0);
            x.push_back(upright ? V{u, v, (2 * r - 1) / 1000} : V{u, 1, v});
        }
    last = x;
    force.resize(x.size());
    pinned.assign(x.size(), false);
    for (int j = 0; j < H; j++)
        for (int i = 0; i < W; i++) {
            auto join = [&](int di, int dj, double k) {
                if (i + di < 0 || i + di >= W || j + dj < 0) return;
                int a = j * W + i, b = (j + dj) * W + i + di;
                springs.push_back({a, b, k, length(x[a] - x[b])});
            };
            join(-1, 0, ks), join(0, -1, ks), join(-1, -1, ks), join(1, -1, ks);
            join(-2, 0, 0.2 * ks), join(0, -2, 0.2 * ks);
        }
}

static void move() {
    std::fill(force.begin(), force.end(), V{0, -9.8 * mass, 0});
    for (const Spring &s : springs) {
        V e = x[s.b] - x[s.a];
        double l = length(e);
        if (l == 0) continue;
        V f = e * (s.k * (l - s.rest) / l);
        force[s.a] = force[s.a] + f;
        force[s.b] = force[s.b] - f;
    }
    for (size_t p = 0; p < x.size(); p++) {
        if (pinned[p]) continue;
        V next = x[p] + (x[p] - last[p]) * keep + force[p] * a2;
        last[p] = x[p];
        x[p] = next;
    }
}

struct Key {
    int64_t x, y, z;
    bool operator==(const Key &o) const { return x == o.x && y == o.y && z == o.z; }
};
struct Hash {
    size_t operator()(const Key &k) const { return k.x * 73856093 ^ k.y * 19349663 ^ k.z * 83492791; }
};

static void collide_with_itself() {
    static std::unordered_map<Key, std::vector<int>, Hash> boxes;
    static std::vector<Key> keys(x.size());
    double bx = 3.0 * 1 / W, by = 3.0 * 1 / H, bz = std::max(bx, by);
    boxes.clear();
    for (size_t p = 0; p < x.size(); p++) {
        keys[p] = {int64_t(std::floor(x[p].x / bx)), int64_t(std::floor(x[p].y / by)), int64_t(std::floor(x[p].z / bz))};
        boxes[keys[p]].push_back(p);
    }
    for (size_t p = 0; p < x.size(); p++) {
        if (pinned[p]) continue;
        V sum{0, 0, 0};
        double count = 0;
        for (int o : boxes[keys[p]]) {
            if (size_t(o) == p) continue;
            V e = x[p] - x[o];
            double l = length(e);
            if (0 < l && l < 2 * thickness) sum = sum + e * ((2 * thickness - l) / l), count += 1;
        }
        if (count > 0) x[p] = x[p] + sum * (1.0 / count / T);
    }
}

static void collide_with_floor() {
    for (size_t p = 0; p < x.size(); p++) {
        if (pinned[p]) continue;
        V n{0, 1, 0}, way = x[p] - last[p];
        double den = dot(way, n), side = dot(last[p], n), s = -side / den;
        if (den != 0 && 0 <= s && s <= 1) {
            V surface = last[p] + way * s + n * (side >= 0 ? 1e-4 : -1e-4);
            x[p] = last[p] + (surface - last[p]) * (1 - friction);
        }
    }
}

static void limit_stretch() {
    for (const Spring &s : springs) {
        V e = x[s.b] - x[s.a];
        double l = length(e), max = 1.1 * s.rest;
        if (l <= max || (pinned[s.a] && pinned[s.b])) continue;
        V c = e * ((l - max) / l);
        if (pinned[s.a]) x[s.b] = x[s.b] - c;
        else if (pinned[s.b]) x[s.a] = x[s.a] + c;
        else x[s.a] = x[s.a] + c * 0.5, x[s.b] = x[s.b] - c * 0.5;
    }
}

static void frame() {
    for (int step = 0; step < T; step++) {
        move();
        collide_with_itself();
        if (floor_below) collide_with_floor();
        limit_stretch();
    }
}

// FNV-1a of the positions and the last positions, component by component.
static uint64_t state_hash() {
    uint64_t hash = 0xCBF29CE484222325;
    for (const std::vector<V> *points : {&x, &last})
        for (double V::*component : {&V::x, &V::y, &V::z})
            for (const V &point : *points) {
                unsigned char bytes[8];
                std::memcpy(bytes, &(point.*component), 8);
                for (unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001B3;
            }
    return hash;
}

int main(int argc, char **argv) {
    std::string name = argc > 1 ? argv[1] : "";
    if (name != "pinned2" && name != "selfCollision") return std::fprintf(stderr, "pinned2 or selfCollision?\n"), 2;
    floor_below = name == "selfCollision";
    start(floor_below);
    if (name == "pinned2") pinned[0] = pinned[W - 1] = true;
    for (int i = 0; i < 90; i++) frame();
    double least = 1e9;
    for (int i = 0; i < 21; i++) {
        auto begin = std::chrono::steady_clock::now();
        frame();
        std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
        least = std::min(least, time.count() / T);
    }
    std::printf("%s: %.1f us a step\n", name.c_str(), least);
    std::printf("state after 111 frames: %016llx\n", static_cast<unsigned long long>(state_hash()));
}
