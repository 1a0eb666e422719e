#!/usr/bin/env python3
"""Random requests to bpview: none ends it, none writes a file, and what is right is answered afterwards as before.

usage: view_fuzz.py BIN_DIR [--requests N] [--seed S] [--seconds T]

BIN_DIR/bpview should be built with sanitizers (preset asan): then a report of theirs ends it, and fails this test. Half of the
requests are damaged lines and headers; the others are well-formed, with the cookie, and damaged bodies and queries.
"""
import argparse, json, os, random, re, shutil, socket, subprocess, sys, tempfile, time
sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "view"))
os.environ.setdefault("ASAN_OPTIONS", "abort_on_error=1:detect_leaks=0")
os.environ.setdefault("UBSAN_OPTIONS", "halt_on_error=1")
from served import Served, comb

PATHS = ["/", "/page.js", "/session", "/api/state", "/api/scene", "/api/proxy", "/api/surface", "/api/layer", "/api/edit", "/api/save", "/api/check", "/api/mesh", "/api/stop", "/api/events"]
KEYS = ["file", "level", "number", "distances", "after", "x"]
VALUES = ["0", "1", "2", "-1", "18446744073709551615", "99999999999999999999", "1e9", "", "%00", "../../etc/passwd", "nan", "0x10", "1;2", "\u00e9"]
BODIES = ['{"op": "rule", "rule": {"at": [1, 1, 1], "radius": 1, "scale": 0.2, "mode": "decrease"}, "again": true}', '{"op": "base", "base": "3%"}', '{"op": "undo"}', '{"op": "redo"}',
          '{"op": "remove", "rule": 0}', '{"op": "faces", "faces": 300}', '{"op": "live", "live": false}', '{"file": 0}', '{"file": 1}', '{"what": "nothing"}', "{}", "[]", "null", '{"op": "rule", "rule": {"node": "*"}}',
          '{"op": "rule", "rule": {"at": [[0,0,0],[1e308,1,1]], "radius": "5%", "scale": "1vx", "mode": "erase"}}', '{"op": "rule", "rule": {"box": [[0,0,0],[1,1,1]], "scale": 0}}',
          '{"op": "orientation", "orientation": "auto"}', '{"op": "orientation", "orientation": [{"at": [1, 1, 1], "frame": [0.9, 0.1, 0, 0.4]}], "again": true}',
          '{"op": "orientation", "orientation": [{"at": [1e308, -1e308, 0], "frame": [[1, 0, 0], [1e300, 1, 0]]}]}', '{"op": "rule", "rule": [{"node": "*", "scale": 0.2}, {"at": [9, 1, 1], "radius": 1, "scale": 0.2}]}']
BYTES = b"GETPOS /:%.\\\r\n\0\xff?=&abc{}\"[]HTTP1,0-9e+"


class Fuzzer:
    def __init__(self, served, seed):
        self.s, self.g = served, random.Random(seed)

    def damaged(self, data):
        """The bytes with some of them changed, left out, doubled, or others put in."""
        data, g = bytearray(data), self.g
        for _ in range(g.choice((0, 1, 1, 2, 5))):
            at = g.randrange(len(data) + 1)
            kind = g.randrange(5)
            if kind == 0 and at < len(data):
                data[at] = g.choice(BYTES)
            elif kind == 1:
                del data[at:at + g.randrange(1, 9)]
            elif kind == 2:
                data[at:at] = bytes(g.choice(BYTES) for _ in range(g.randrange(1, 9)))
            elif kind == 3:
                data[at:at] = data[at:at + g.randrange(1, 40)] * g.choice((1, 2, 30))
            else:
                data[at:at] = g.choice((b"-1", b"1e999", b"[" * 400, b"null", b"99999999999999999999", b'"\\ud800"', b"\xc3\x28"))
        return bytes(data)

    def target(self):
        path = self.g.choice(PATHS)
        if self.g.random() < 0.5:
            path += "?" + "&".join(f"{self.g.choice(KEYS)}={self.g.choice(VALUES)}" for _ in range(self.g.randrange(1, 4)))
        return path.encode()

    def request(self):
        g, s = self.g, self.s
        body = g.choice(BODIES).encode()
        if g.random() < 0.6:
            body = self.damaged(body)
        method = b"POST" if g.random() < 0.6 else b"GET"
        lines = [method + b" " + self.target() + b" HTTP/1.1", b"Host: 127.0.0.1:%d" % s.port, b"Connection: " + g.choice((b"close", b"keep-alive"))]
        if g.random() < 0.9:
            lines += [b"Origin: " + s.origin.encode(), b"Cookie: " + s.cookie.encode()]
        if method == b"POST":
            lines.append(b"Content-Length: " + (str(len(body)).encode() if g.random() < 0.9 else g.choice((b"-1", b"0", b"999999999999", b"x", b"5"))))
            if g.random() < 0.1:
                lines.append(g.choice((b"Transfer-Encoding: chunked", b"Content-Encoding: gzip", b"Expect: 100-continue", b"Content-Type: multipart/form-data; boundary=x",
                                       b"Range: bytes=0-,5-1,-3", b"Sec-Fetch-Site: cross-site", b"X: " + b"y" * 9000)))
        whole = b"\r\n".join(lines) + b"\r\n\r\n" + (body if method == b"POST" else b"")
        return self.damaged(whole) if g.random() < 0.5 else whole

    def send(self, data):
        """Sends a request, and reads a part of the answer now and then: most clients hang up."""
        with socket.create_connection(("127.0.0.1", self.s.port), timeout=20) as one:
            try:
                one.sendall(data)
                if self.g.random() < 0.7:
                    one.shutdown(socket.SHUT_WR)
                    one.recv(256)
            except OSError:
                pass


def main():
    args = argparse.ArgumentParser()
    args.add_argument("bin_dir")
    args.add_argument("--requests", type=int, default=100000)
    args.add_argument("--seed", type=int, default=1)
    args.add_argument("--seconds", type=float, default=1e9)
    o = args.parse_args()
    os.environ["PATH"] = os.path.abspath(o.bin_dir) + ":" + os.environ["PATH"]
    folder = tempfile.mkdtemp(prefix="view_fuzz_")
    comb(f"{folder}/served.obj")
    subprocess.run(["bash", "-c", "set -o pipefail; bpvox served.obj --resolution 24 | bpclose -s 5% | tee closed.bpv | bpmesh --faces 60 -o made.glb"], cwd=folder, check=True, stderr=subprocess.DEVNULL)
    before = sorted(os.listdir(folder))
    s = Served("served.obj", "--resolution", "24", "--faces", "60", "--show", "made.glb", "--show", "closed.bpv", cwd=folder)
    s.enter()
    fuzzer, begin, sent, wrong = Fuzzer(s, o.seed), time.time(), 0, []
    while sent < o.requests and time.time() - begin < o.seconds and not wrong:
        data = fuzzer.request()
        try:
            fuzzer.send(data)
        except OSError as error:
            wrong.append(f"request {sent} found no server: {error}: {data[:400]!r}")
        sent += 1
        if sent % 1000 == 0 and s.process.poll() is not None:
            wrong.append(f"bpview ended with {s.process.returncode} after {sent} requests")
    if not wrong:
        s.post("/api/stop")
        s.edit(op="base", base="4%")
        state = s.state()
        if state["design"]["base"] != "4%":
            wrong.append("the design is not edited any more")
        for path in ("/api/scene", "/api/layer?file=0", "/api/layer?file=1&distances=1"):
            if s.ask("GET", path)[0] != 200:
                wrong.append(f"{path} is not answered any more")
        code, said = s.end()
        if code != 0 or re.search("runtime error|AddressSanitizer", said):
            wrong.append(f"bpview ended with {code}: {said[-3000:]}")
    else:
        s.process.kill()
        wrong.append(s.process.communicate()[1][-3000:])
    left = sorted(set(os.listdir(folder)) - set(before) - {"rules.json", "proxy.glb"})  # a damaged body may ask to save these
    if left:
        wrong.append(f"files were written: {left}")
    shutil.rmtree(folder)
    print(f"{sent} requests in {time.time() - begin:.0f} s: " + ("; ".join(wrong) or "nothing wrong"))
    sys.exit(bool(wrong))


main()
