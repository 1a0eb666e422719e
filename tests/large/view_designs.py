#!/usr/bin/env python3
"""Random designs of bpview: what it shows and saves has the bytes of the command line of its page, whatever the memory.

usage: view_designs.py BIN_DIR [--designs N] [--seed S] [--memory SIZES] [--cuda] [--scene FILE...]

BIN_DIR holds the tools. Each design has a seed of its own, S, S + 1, ...: scene, options and steps follow from it, so `--seed X --designs 1`
repeats one. A bpview for each of SIZES (default 400M,8G) takes the same steps: strokes with and without mirror plane, undo, redo, sliders,
rules of other kinds, orientation. Compared are the saved rules and proxies, the surface of the closing, vertex by vertex, with that of the
command line's closing, and its voxels. --cuda: one more bpview with --device cuda, and the command line on the GPU, too.
Prints a line for each design. Exit status 1 if one differs.
"""
import argparse, os, random, shutil, subprocess, sys, tempfile, time
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "view"))
from designs import Steps, by_command_line, finished, live_surface, run, shown_surface, take, voxels_of
from served import Served, comb

SAMPLES = ["figure.obj", "house.obj", "truck.obj", "office.obj", "engine.obj", "comb.obj"]


class Trial:
    """A design, on one server for each limit of memory and device."""
    def __init__(self, seed, folder, scenes, servers):
        self.seed, self.folder, self.servers, self.wrong, self.proven = seed, folder, servers, [], ""
        choice = random.Random(seed)
        self.scene = choice.choice(scenes)
        self.options = ["--resolution", str(choice.choice((48, 64, 96, 128))), "--faces", str(choice.choice((100, 400, 1000)))]
        if choice.random() < 0.25:
            self.options += ["--element", "ball"]
        if choice.random() < 0.25:
            self.options += ["--fill", choice.choice(("winding", "none"))]
        self.live = choice.random() < 0.25
        self.steps = choice.randrange(6, 24)

    def same(self, what, fine):
        if not fine:
            self.wrong.append(what)

    def start(self, options):
        folder = tempfile.mkdtemp(dir=self.folder)
        for name in os.listdir(os.path.dirname(self.scene)):
            if name.split(".")[0] == os.path.basename(self.scene).split(".")[0]:  # the scene and its materials
                os.symlink(os.path.join(os.path.dirname(self.scene), name), f"{folder}/{name}")
        name = os.path.basename(self.scene)
        run(f"bpvox {name} --resolution 16 | bpclose -s 2% -o closed.bpv", folder)  # the command line's closing will replace it
        served = Served(name, *self.options, *options, "--show", "closed.bpv", cwd=folder)
        served.enter()
        return folder, served

    def __call__(self, cuda):
        started = [self.start(options) for options in self.servers]
        for _, served in started:
            served.edit(op="live", live=self.live)
            steps = Steps(self.seed, served)  # each server gets the same ones
            for _ in range(self.steps):
                take(served, steps.step())
        made = [finished(served, folder) for folder, served in started]
        state, rules, proxy = made[0]
        self.proven = (state["proxy"]["verdict"] or {}).get("answer", "no answer")
        for other, options in zip(made[1:], self.servers[1:]):
            self.same(f"rules of {options}", other[1] == rules)
            self.same(f"proxy of {options}", other[2] == proxy)
        folder, served = started[0]
        for environment in [{"BP_BACKEND": "cpu"}] + ([{"BP_BACKEND": "cuda"}] if cuda else []):
            self.same(f"proxy of the command line, {environment}", by_command_line(state["command"], folder, **environment) == proxy)
            surface = shown_surface(served, 0)
            voxels = voxels_of(folder)
            for (_, one), (its_state, *_), options in zip(started, made, self.servers):
                self.same(f"voxels of {options}, {environment}", its_state["closing"]["voxels"] == voxels)
                self.same(f"surface of {options}, {environment}", live_surface(one) == surface)
        for _, served in started:
            code, said = served.end()
            self.same(f"the end: {code} {said}", code == 0)
        rules_count = len(state["design"]["rules"])
        return f"{os.path.basename(self.scene)} {' '.join(self.options)}, {self.steps} steps, {rules_count} rules, {state['closing']['voxels']} voxels, {self.proven}"


def main():
    args = argparse.ArgumentParser()
    args.add_argument("bin_dir")
    args.add_argument("--designs", type=int, default=100)
    args.add_argument("--seed", type=int, default=1)
    args.add_argument("--memory", default="400M,8G")
    args.add_argument("--cuda", action="store_true")
    args.add_argument("--scene", nargs="*", default=[])
    o = args.parse_args()
    os.environ["PATH"] = os.path.abspath(o.bin_dir) + ":" + os.environ["PATH"]
    home = tempfile.mkdtemp(prefix="view_designs_")
    scenes = [os.path.abspath(name) for name in o.scene]
    if not scenes:
        subprocess.run([sys.executable, f"{HERE}/../../samples/scenes.py", f"{home}/scenes"], check=True, stdout=subprocess.DEVNULL)
        comb(f"{home}/scenes/comb.obj")
        scenes = [f"{home}/scenes/{name}" for name in SAMPLES]
    servers = [["--memory", size, "--device", "cpu"] for size in o.memory.split(",")]
    if o.cuda:
        servers.append(["--memory", o.memory.split(",")[-1], "--device", "cuda"])
    wrong = proven = 0
    for seed in range(o.seed, o.seed + o.designs):
        begin, folder = time.time(), f"{home}/{seed}"
        os.mkdir(folder)
        trial = Trial(seed, folder, scenes, servers)
        told = trial(o.cuda)
        wrong += bool(trial.wrong)
        proven += trial.proven == "proven"
        print(f"seed {seed}: {told}, {time.time() - begin:.1f} s: {'DIFFER: ' + '; '.join(trial.wrong) if trial.wrong else 'same'}", flush=True)
        shutil.rmtree(folder)
    shutil.rmtree(home)
    print(f"{o.designs} designs from seed {o.seed}, {' and '.join(' '.join(options) for options in servers)}: {o.designs - wrong} have the bytes of the command line, {proven} proven")
    sys.exit(bool(wrong))


main()
