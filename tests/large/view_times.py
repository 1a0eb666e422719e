#!/usr/bin/env python3
"""Times of bpview, as a client on the same machine sees them: strokes, strokes that open and close a hollow, and the start.

usage: view_times.py BIN_DIR [--scene FILE] [--strokes N] [--resolution N...] [--plant TRIANGLES [--memory SIZE]] [--options "..."]

BIN_DIR holds the tools (bpview finds the others beside itself) and, for --plant, bp-plant. A stroke's time is that from its request to the
last byte of the surface that changed; "ready" is the part until the server has the surface, and the processor seconds of bpview tell more than
both where other work runs beside. Near strokes make 3 % of the diagonal finer at
random points of the surface. A hollow is the inside of a jar whose mouth the base scale shuts: strokes at the mouth open it, and undo shuts it.
--plant generates a plant, and tells the time from the start of bpview to its link and to the first surface, and the peak of memory; then
strokes. Proxies are not made meanwhile; then some are, and their time from the stroke is told. Without --scene: the figure of samples/scenes.py.
"""
import argparse, http.client, json, os, random, resource, shutil, struct, subprocess, sys, tempfile, time
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "view"))
from designs import pieces
from served import Served

RADIUS, FINE = 0.03, "0.5%"  # of near strokes: share of the diagonal, and their scale


class Watched(Served):
    """bpview, whose events tell when a surface is ready."""
    def __init__(self, *args, cwd):
        self.begin = time.perf_counter()
        super().__init__(*args, cwd=cwd)
        self.linked = time.perf_counter() - self.begin
        self.enter()
        self.events = http.client.HTTPConnection("127.0.0.1", self.port)
        self.events.request("GET", "/api/events", headers={"Cookie": self.cookie})
        self.answer = self.events.getresponse()
        self.edit(op="live", live=False)
        self.post("/api/stop")
        self.generation = 0

    def until_shown(self, revision):
        """The surface of a revision: the state, and the bytes that changed."""
        while True:
            line = self.answer.readline()
            assert line, "bpview ended"
            if line.startswith(b"data: "):
                state = json.loads(line[6:])
                assert not state["closing"]["error"], state["closing"]["error"]
                if state["closing"]["shown"] >= revision:
                    break
        data = self.ask("GET", f"/api/surface?after={self.generation}")[2]
        self.generation = struct.unpack_from("<I", data)[0]
        return state, data

    def processor(self):
        """Seconds of the processor that bpview has used, to a tick of 10 ms."""
        with open(f"/proc/{self.process.pid}/stat") as file:
            return sum(map(int, file.read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")

    def timed(self, **edit):
        """Makes a step. Returns the seconds until its surface is here, those until it was ready, its bytes, and the processor seconds."""
        begin, used = time.perf_counter(), self.processor()
        revision = json.loads(self.ask("POST", "/api/edit", json.dumps(edit))[2])["revision"]
        state, data = self.until_shown(revision)
        return time.perf_counter() - begin, state["closing"]["seconds"], len(data), self.processor() - used


def places(data, count, generator):
    """Random vertices of a surface, in scene units."""
    (_, _, voxel, origin), all = pieces(data)
    found = []
    for brick, vertices, _, at in all:
        start = [origin[k] + (brick[k] * 64 - 8) * voxel for k in range(3)]
        for i in range(generator.randrange(97), vertices, 97):
            found.append([s + p * voxel / 256 for s, p in zip(start, struct.unpack_from("<3H", data, at + 12 * i))])
    return generator.choices(found, k=count)


def tell(what, rows):
    def ms(at):
        values = sorted(row[at] for row in rows)
        return f"{1000 * values[len(values) // 2]:.0f}, {1000 * values[int(0.95 * (len(values) - 1))]:.0f}"
    sizes = sorted(row[2] for row in rows)
    print(f"{what}: {len(rows)} strokes, median and 95 %: {ms(0)} ms to the last byte, {ms(1)} ms until ready, {sizes[len(sizes) // 2] / 1e6:.2f} MB, "
          f"{1000 * sum(row[3] for row in rows) / len(rows):.0f} ms of the processor on average", flush=True)


def near(s, state, data, strokes, what):
    radius = RADIUS * state["scene"]["diagonal"]
    rule = lambda at: {"at": at, "radius": radius, "scale": FINE, "mode": "decrease"}
    tell(what, [s.timed(op="rule", rule=rule(at)) for at in places(data, strokes, random.Random(1))])


def proxies(s, state, data, strokes, what):
    """Strokes with a proxy after each: the time until there is one, and until bpcheck has answered."""
    radius, made, proven = RADIUS * state["scene"]["diagonal"], [], []
    for at in places(data, strokes, random.Random(3)):
        begin = time.perf_counter()
        revision = json.loads(s.ask("POST", "/api/edit", json.dumps({"op": "rule", "rule": {"at": at, "radius": radius, "scale": FINE, "mode": "decrease"}}))[2])["revision"]
        s.edit(op="live", live=True)
        mine = lambda q: q["proxy"]["revision"] == revision and q["proxy"]["step"] in ("checking", "ready")
        s.wait(mine)
        made.append(time.perf_counter() - begin)
        state = s.wait(lambda q: mine(q) and q["proxy"]["step"] == "ready")
        proven.append(time.perf_counter() - begin)
        assert state["proxy"]["verdict"]["answer"] == "proven", state["proxy"]
        s.edit(op="live", live=False)
    median = lambda values: sorted(values)[len(values) // 2]
    print(f"{what}: {strokes} proxies of {state['faces']} faces, median {median(made):.2f} s after the stroke, proven after {median(proven):.2f} s", flush=True)


def jar(path, mouth=0.8, wall=0.6, size=10.0):
    """A box with walls, and a square mouth in the middle of its top."""
    a, b, low, high = (size - mouth) / 2, (size + mouth) / 2, size - wall, size
    boxes = [((0, 0, 0), (size, wall, size)), ((0, 0, 0), (wall, size, size)), ((low, 0, 0), (high, size, size)), ((0, 0, 0), (size, size, wall)),
             ((0, 0, low), (size, size, high)), ((0, low, 0), (a, high, size)), ((b, low, 0), (size, high, size)), ((a, low, 0), (b, high, a)), ((a, low, b), (b, high, size))]
    with open(path, "w") as out:
        for n, corners in enumerate(boxes):
            for i in range(8):
                out.write("v " + " ".join(str(corners[i >> k & 1][k]) for k in range(3)) + "\n")
            for quad in ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)):
                out.write("f " + " ".join(str(8 * n + v + 1) for v in quad) + "\n")


def hollow(s, strokes, what):
    """The base closes the mouth; strokes open it, and undo closes it again."""
    s.until_shown(json.loads(s.ask("POST", "/api/edit", json.dumps({"op": "base", "base": "5%"}))[2])["revision"])
    generator, opening, closing = random.Random(2), [], []
    for _ in range(strokes // 2):
        at = [5 + generator.uniform(-0.1, 0.1), 9.7, 5 + generator.uniform(-0.1, 0.1)]
        before = s.state()["closing"]["voxels"]
        opening.append(s.timed(op="rule", rule={"at": at, "radius": 1.5, "scale": 0.15, "mode": "decrease"}))
        assert s.state()["closing"]["voxels"] < 0.7 * before, "the stroke opens no hollow"
        closing.append(s.timed(op="undo"))
    tell(f"{what}, opened", opening)
    tell(f"{what}, closed", closing)


def plant(o, folder):
    """The start with a scene in the page cache, and strokes on it."""
    subprocess.run(["bp-plant", "--triangles", str(o.plant), "--seed", "7", "-o", "plant.ply"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    with open(f"{folder}/plant.ply", "rb") as file:
        while file.read(1 << 24):
            pass
    s = Watched("plant.ply", "--resolution", str(o.resolution[-1]), "--memory", o.memory, *o.options.split(), cwd=folder)
    state, data = s.until_shown(1)
    ready = time.perf_counter() - s.begin
    with open(f"/proc/{s.process.pid}/status") as file:
        own = next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) / 1024
    print(f"plant of {o.plant} triangles, {os.path.getsize(f'{folder}/plant.ply') / 1e9:.2f} GB, {o.resolution[-1]} voxels, --memory {o.memory}: "
          f"link after {s.linked:.2f} s, first surface after {ready:.2f} s; bpview's peak {own:.0f} MiB", flush=True)
    near(s, state, data, o.strokes, f"plant, {o.resolution[-1]} voxels")
    s.end()
    print(f"largest peak of bpview and its tools: {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024:.0f} MiB")


def main():
    args = argparse.ArgumentParser()
    args.add_argument("bin_dir")
    args.add_argument("--scene")
    args.add_argument("--strokes", type=int, default=100)
    args.add_argument("--resolution", type=int, nargs="+", default=[256, 512])
    args.add_argument("--plant", type=int, default=0)
    args.add_argument("--memory", default="2G")
    args.add_argument("--options", default="")
    o = args.parse_args()
    os.environ["PATH"] = os.path.abspath(o.bin_dir) + ":" + os.environ["PATH"]
    folder = tempfile.mkdtemp(prefix="view_times_")
    if o.plant:
        plant(o, folder)
    else:
        scene = o.scene and os.path.abspath(o.scene)
        if not scene:
            subprocess.run([sys.executable, f"{HERE}/../../samples/scenes.py", folder, "figure"], check=True, stdout=subprocess.DEVNULL)
            scene = f"{folder}/figure.obj"
        jar(f"{folder}/jar.obj")
        for resolution in o.resolution:
            for name, path in (("near", scene), ("hollow", f"{folder}/jar.obj")):
                s = Watched(path, "--resolution", str(resolution), *o.options.split(), cwd=folder)
                state, data = s.until_shown(1)
                print(f"{os.path.basename(path)}, {resolution} voxels: ready after {time.perf_counter() - s.begin:.2f} s", flush=True)
                if name == "near":
                    near(s, state, data, o.strokes, f"near, {resolution} voxels")
                    proxies(s, state, data, max(3, o.strokes // 10), f"proxy, {resolution} voxels")
                else:
                    hollow(s, o.strokes, f"hollow, {resolution} voxels")
                s.end()
    shutil.rmtree(folder)


main()
