"""Random designs of bpview, and what the command line of its page makes of them."""
import json, os, random, struct, subprocess


class Steps:
    """Random steps of a person at a scene: the same ones for a seed, whatever server shows the scene."""
    def __init__(self, seed, served):
        self.random = random.Random(seed)
        scene = served.state()["scene"]
        self.parts = json.loads(served.ask("GET", "/api/parts")[2])
        self.low, self.high, self.middle, self.diagonal = scene["min"], scene["max"], scene["middle"], scene["diagonal"]

    def number(self, low, high):
        return float(f"{self.random.uniform(low, high):.4g}")

    def point(self):
        return [self.number(a - 0.1 * (b - a), b + 0.1 * (b - a)) for a, b in zip(self.low, self.high)]

    def length(self, low, high):
        """A length between two shares of the diagonal, in each of the ways to write one."""
        share = self.random.uniform(low, high)
        return self.random.choice([f"{100 * share:.3g}%", float(f"{share * self.diagonal:.4g}"), f"{max(1, round(256 * share))}vx"])

    def stroke(self):
        """A dab or a path; a list of two where the mirror plane is on."""
        rule = {"at": self.random.choice([self.point(), [self.point() for _ in range(self.random.randrange(2, 5))]]), "radius": self.length(0.01, 0.15),
                "mode": self.random.choice(["increase", "decrease", "erase"])}
        if rule["mode"] != "erase":
            rule["scale"] = self.length(0.003, 0.06)
        if self.random.random() < 0.5:
            return rule
        axis = self.random.randrange(3)
        image = lambda p: [2 * self.middle[axis] - x if k == axis else x for k, x in enumerate(p)]
        return [rule, {**rule, "at": [image(p) for p in rule["at"]] if isinstance(rule["at"][0], list) else image(rule["at"])}]

    def placed(self):
        """A rule that is no stroke."""
        low = self.point()
        rules = [{"box": [low, [x + self.number(0, 0.3) * self.diagonal for x in low]], "scale": self.length(0.003, 0.05), "radius": self.length(0, 0.05)},
                 {"at": self.point(), "support": self.length(0.02, 0.2), "scale": self.length(0.003, 0.05)},
                 {"gap": self.length(0.01, 0.05)}, {"thickness": self.length(0.01, 0.03)}]
        if self.parts:
            rules += 2 * [{"node": self.random.choice(self.parts), "scale": self.length(0.003, 0.05), "mode": self.random.choice(["increase", "decrease"])}]
        return self.random.choice(rules)

    def frames(self):
        return [{"at": self.point(), "frame": [self.number(0.5, 1), *(self.number(-1, 1) for _ in range(3))]} for _ in range(self.random.randrange(1, 4))]

    def step(self):
        """One step, as requests: a slider and a drag are several."""
        kind = self.random.random()
        if kind < 0.4:
            return [{"op": "rule", "rule": self.stroke(), "again": again} for again in [False] + self.random.randrange(3) * [True]]
        if kind < 0.5:
            return [{"op": "rule", "rule": self.placed()}]
        if kind < 0.65:
            return self.random.randrange(1, 4) * [{"op": "undo"}]
        if kind < 0.8:
            return self.random.randrange(1, 3) * [{"op": "redo"}]
        if kind < 0.9:
            return [{"op": "base", "base": self.length(0.005, 0.05), "again": again} for again in [False] + self.random.randrange(6) * [True]]
        if kind < 0.93:
            return [{"op": "remove", "share": self.random.random()}]
        value = self.random.choice(["auto", self.frames(), self.frames(), None])
        return [{"op": "orientation", "orientation": value, "again": again} for again in [False] + self.random.randrange(2) * [True]]


def take(served, requests):
    for request in requests:
        if request["op"] == "remove":
            count = len(served.state()["design"]["rules"])
            if count > 0:
                served.edit(op="remove", rule=int(request["share"] * count))
        else:
            served.edit(**request)


def finished(served, folder):
    """Makes and saves the proxy of the design as it is. Returns the state, and the bytes of both files."""
    served.post("/api/mesh")
    state = served.wait(lambda q: q["proxy"]["step"] in ("ready", "failed") and q["proxy"]["current"] and q["closing"]["shown"] == q["design"]["revision"], 600)
    files = []
    for what, name in (("rules", state["rules_file"]), ("proxy", state["out_file"])):
        served.post("/api/save", {"what": what})
        with open(f"{folder}/{name}", "rb") as file:
            files.append(file.read())
    return state, *files


def run(line, folder, **environment):
    subprocess.run(["bash", "-c", "set -o pipefail; " + line], cwd=folder, check=True, stderr=subprocess.DEVNULL, env={**os.environ, **environment})


def by_command_line(command, folder, **environment):
    """Runs the command line of the page. Returns the bytes of its proxy; its closing is in closed.bpv."""
    first, last = command.split(" | bpmesh")
    run(f"{first} | tee closed.bpv | bpmesh{last} --overwrite", folder, **environment)
    with open(f"{folder}/{command.split(' -o ')[1]}", "rb") as file:
        return file.read()


def voxels_of(folder):
    told = subprocess.run(["bpinfo", "--json", "closed.bpv"], cwd=folder, check=True, capture_output=True).stdout
    return json.loads(told)["layers"]["closing"]["voxels"]


def pieces(data):
    """The head of an answer to /api/surface: generation, whether it is whole, voxel and origin; then each piece: brick, vertices, faces, and where its vertices begin."""
    generation, whole, count, _, voxel, *origin = struct.unpack_from("<4I4d", data)
    found, at = [], 48
    for _ in range(count):
        brick, (vertices, faces) = struct.unpack_from("<3i", data, at), struct.unpack_from("<2I", data, at + 12)
        at += 20
        found.append((brick, vertices, faces, at))
        at += 12 * vertices + (8 if vertices <= 65535 else 16) * faces
    assert at == len(data), (at, len(data))
    return (generation, whole == 1, voxel, origin), found


def live_surface(served):
    """The surface that the page draws of the closing: the number of triangles, and each vertex with its normal, sorted."""
    middle = served.state()["scene"]["middle"]
    data = served.ask("GET", "/api/surface?after=0")[2]
    (_, _, voxel, origin), all = pieces(data)
    vertices = []
    for brick, count, _, at in all:
        start = [origin[k] - middle[k] + (brick[k] * 64 - 8) * voxel for k in range(3)]
        for x, y, z, _, normal in struct.iter_unpack("<4H4s", data[at:at + 12 * count]):
            vertices.append(struct.pack("<3f", *(s + p * (voxel / 256) for s, p in zip(start, (x, y, z)))) + normal)
    return 2 * sum(faces for _, _, faces, _ in all), sorted(vertices)


def shown_surface(served, file):
    """The same of a file of voxels that --show named."""
    status, _, data = served.ask("GET", f"/api/layer?file={file}")
    assert status == 200, data
    count, normals, triangles = struct.unpack_from("<3I", data)
    return triangles, sorted(data[24 + 12 * i:36 + 12 * i] + data[24 + 12 * count + 4 * i:28 + 12 * count + 4 * i] for i in range(min(count, normals)))
