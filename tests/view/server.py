#!/usr/bin/env python3
"""Who gets in to bpview, and what comes out: hosts, origins, tokens, paths, sizes, and bytes as the command line makes them.
   tests/view/server.py FOLDER      the tools are on PATH; FOLDER is made anew"""
import json, math, os, random, shutil, signal, socket, struct, subprocess, sys, threading, time
from designs import Steps, by_command_line, finished, live_surface, shown_surface, take, voxels_of
from served import Served, comb, comb_boxes

failed = 0


def check(what, fine, *facts):
    global failed
    if not fine:
        failed += 1
        print("FAILED:", what, *facts)


def who_gets_in(s):
    status = lambda *args, **more: s.ask(*args, **more)[0]
    page = s.ask("GET", "/", own=False)
    check("the page needs no token", page[0] == 200, page[0])
    check("the page has its policy", page[1]["Content-Security-Policy"].startswith("default-src 'self';"))
    check("no type is guessed", page[1]["X-Content-Type-Options"] == "nosniff")
    check("no other site may read", page[1]["Access-Control-Allow-Origin"] is None)
    for path in ("/api/state", "/api/parts", "/api/part?x=0&y=0&z=0", "/api/rules", "/api/scene", "/api/surface", "/api/proxy", "/api/layer?file=0", "/api/events"):
        check("a stranger reads nothing", status("GET", path) == 401, path)
        check("a wrong cookie is none", status("GET", path, headers={"Cookie": f"bpview_{s.port}=" + "0" * 32}) == 401, path)
    check("a stranger changes nothing", status("POST", "/api/edit", '{"op": "undo"}') == 401)
    for token in ("", "0" * 32, s.token[:-1], s.token + "0", s.token.upper() + "x"):
        check("a wrong token is refused", status("POST", "/session", token) == 403, token)
    check("a token from another site is refused", status("POST", "/session", s.token, headers={"Origin": "http://evil.example"}) == 403)
    s.enter()
    for word in ("HttpOnly", "SameSite=Strict", "Path=/"):
        check("the cookie is kept from others", word in s.set_cookie, s.set_cookie)
    check("the page reads", status("GET", "/api/state") == 200)
    check("parts have names", json.loads(s.ask("GET", "/api/parts")[2]) == [f"part_{i}" for i in range(7)], s.ask("GET", "/api/parts")[2])
    for point, part in (((5, 0.5, 7), 0), ((5.2, 3, 4), 4), ((1e9, 3, 1), 0)):
        answer = s.ask("GET", "/api/part?x={}&y={}&z={}".format(*point))
        check("a point has the part that is nearest", json.loads(answer[2]) == {"part": f"part_{part}"}, point, answer)
    for host in ("evil.example", f"evil.example:{s.port}", "127.0.0.1", f"127.0.0.1.evil.example:{s.port}", f"[::1]:{s.port}", "", f"127.0.0.1:{s.port + 1}"):
        check("another host is refused", status("GET", "/api/state", headers={"Host": host}) == 421, host)
        check("even for the page", status("GET", "/", headers={"Host": host}) == 421, host)
    check("localhost is this server, too", status("GET", "/api/state", headers={"Host": f"localhost:{s.port}"}) == 200)
    before = s.state()["design"]["revision"]
    edit = '{"op": "base", "base": "4%"}'
    for origin in ("http://evil.example", "null", "", f"https://127.0.0.1:{s.port}", "http://127.0.0.1", s.origin + ".evil.example", s.origin + "/"):
        check("another origin is refused", status("POST", "/api/edit", edit, headers={"Origin": origin}) == 403, origin)
    check("no origin is refused", status("POST", "/api/edit", edit, headers={"Cookie": s.cookie}, own=False) == 403)
    check("another site may not embed", status("GET", "/api/scene", headers={"Sec-Fetch-Site": "cross-site"}) == 403)
    for method in ("PUT", "DELETE", "OPTIONS", "PATCH", "HEAD"):
        check("other methods are refused", status(method, "/api/state") in (400, 405), method)
    check("nothing was changed", s.state()["design"]["revision"] == before)


def what_is_asked(s):
    for path in ("/../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/api/../../etc/passwd", "//etc/passwd", "/page.js/../../x", "/api/scene/../../rules.json",
                 "/..%2f..%2fetc%2fpasswd", "/rules.json", "/served.obj", "/api/", "/api/surface/1", "/index.html%00", "/\\..\\x", "/.git/config"):
        status, _, body = s.ask("GET", path)
        check("a path leads nowhere", status in (400, 404) and b"root:" not in body, path, status)
    for after in ("-1", "x", "99999999999999999999999999", "1e3", "%00", "1;2"):
        check("what is no number is refused", s.ask("GET", f"/api/surface?after={after}")[0] == 400, after)
    for point in ("", "x=1&y=2", "x=1&y=2&z=", "x=1&y=2&z=nan", "x=1&y=2&z=1e999", "x=1&y=2&z=3,4", "x=1&y=two&z=3", "x=%00&y=2&z=3"):
        check("what is no point is refused", s.ask("GET", f"/api/part?{point}")[0] == 400, point)
    before = s.state()["design"]
    big = b"[" * (2 << 20)
    check("a huge body is refused", s.ask("POST", "/api/edit", big)[0] == 413)
    check("a deep body is refused", s.ask("POST", "/api/edit", b"[" * 900000)[0] == 400)
    check("a huge token is refused", s.ask("POST", "/session", big)[0] == 413)
    rule = {"at": [1, 1, 1], "radius": 1, "scale": 0.1}
    for body in ("", "{}", "[]", "null", '"x"', '{"op": 1}', '{"op": "save"}', '{"op": "rule"}', '{"op": "rule", "rule": 5}', '{"op": "faces", "faces": -1}', '{"op": "faces", "faces": 1e99}',
                 '{"op": "faces", "faces": 3}', '{"op": "remove", "rule": 7}', '{"op": "base", "base": "999%"}', '{"op": "orientation"}', '{"op": "orientation", "orientation": "by hand"}', '{"op": "orientation", "orientation": [{"at": [0, 0, 0]}]}',
                 '{"op": "rule", "rule": []}', '{"op": "rule", "rule": [5]}', '{"op": "base", "base": [[[[[[[[[[1]]]]]]]]]]}', '{"op": "base"',
                 json.dumps({"op": "rule", "rule": {**rule, "file": "/etc/passwd"}}), json.dumps({"op": "rule", "rule": {**rule, "at": [1e400, 0, 0]}}),
                 json.dumps({"op": "rule", "rule": {"node": "*", "scale": "\ud800"}}), '{"op": "rule", "rule": {"at": [1,1,1], "radius": 1, "scale": 1e308}}', b"\xff\xfe\x00"):
        status, _, answer = s.ask("POST", "/api/edit", body)
        check("nonsense is refused, and says why", status == 400 and json.loads(answer)["error"], body, status, answer)
    for body in ('{"what": "/etc/passwd"}', '{"what": "rules", "file": 5', '{}', '{"what": ["rules"]}'):
        check("what is saved has a name of its own", s.ask("POST", "/api/save", body)[0] == 400, body)
    for query in ("", "?file=0", "?file=1&level=9", "?file=-1", "?file=../../etc/passwd", "?level=0&file=999999999999"):
        status, _, answer = s.ask("GET", "/api/layer" + query)
        check("a file that was not named is refused", status == 400 and json.loads(answer)["error"], query, status, answer)
    check("a proxy that is not kept is refused", s.ask("GET", "/api/proxy?number=4711")[0] == 400)
    for body in ('{"file": 0}', '{"file": -1}', '{"file": "served.obj"}', "{}", "[]"):
        check("a file that was not named is not proven", s.ask("POST", "/api/check", body)[0] == 400, body)
    check("nothing was changed", s.state()["design"] == before)
    generator = random.Random(1)
    for _ in range(300):
        line = bytes(generator.choice(b"GETPOS /:%.\\\r\n\0\xff?=&abc{}\"[]HTTP1") for _ in range(generator.randrange(400)))
        with socket.create_connection(("127.0.0.1", s.port)) as one:
            try:
                one.send((b"POST /api/edit HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n" % s.port if generator.random() < 0.5 else b"") + line)
            except OSError:
                pass
    check("noise ends nothing", s.ask("GET", "/api/state")[0] == 200 and s.process.poll() is None)


def slow_clients(s):
    """More clients than the server has threads, without the cookie: they send a byte now and then, or take no byte of their answers."""
    def clients(request, receives):
        all = []
        for _ in range(40):
            one = socket.socket()
            if not receives:
                one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
            one.settimeout(10)
            one.connect(("127.0.0.1", s.port))
            one.settimeout(0.05)
            all.append(one)
            send(one, request)
        return all

    def send(one, data):
        try:
            one.send(data)
        except OSError:
            pass  # it was ended

    def longest(what, others):
        done, waits = threading.Event(), []

        def trickle():
            while not done.wait(0.5):
                for one in others:
                    send(one, b"x")

        trickling = threading.Thread(target=trickle)
        trickling.start()
        for _ in range(4):
            begin = time.time()
            try:
                fine = s.ask("GET", "/api/state")[0] == 200
            except OSError as error:
                fine = error
            waits.append(time.time() - begin)
            check(what, fine is True and waits[-1] < 2, fine, waits)
            if waits[-1] >= 2:
                break
            time.sleep(0.4)
        done.set()
        trickling.join()
        for one in others:
            one.close()
        return max(waits)

    host = b"Host: 127.0.0.1:%d\r\n" % s.port
    page = b"GET / HTTP/1.1\r\n" + host + b"\r\n"
    waits = [longest("clients that send byte by byte keep nobody out", clients(b"GET /api/state HTTP/1.1\r\n" + host + b"X: ", True)),
             longest("clients that send nothing keep nobody out", clients(b"", True)),
             longest("clients that ask again and again keep nobody out", clients(page, True)),
             longest("clients that read nothing keep nobody out", clients(400 * page, False)),
             longest("clients whose bodies are slow keep nobody out", clients(b"POST /session HTTP/1.1\r\n" + host + b"Origin: %s\r\nContent-Length: 100000\r\n\r\n" % s.origin.encode(), True))]
    # Pages of the same person may be slow: they take a thread each, and no other one is ended.
    own = b"GET /api/scene HTTP/1.1\r\n" + host + b"Cookie: " + s.cookie.encode() + b"\r\n\r\n"
    waits.append(longest("slow pages of the same person keep nobody out", clients(own, False)[:8]))
    print("longest waits beside slow clients:", " ".join(f"{wait:.2f}" for wait in waits), "s")


def same_bytes(s, folder):
    """Designs of random steps: what is saved and shown is what the command line makes."""
    steps = Steps(4, s)
    s.edit(op="live", live=False)
    for round_ in range(3):
        for _ in range(12):
            take(s, steps.step())
        s.edit(op="rule", rule={"node": "part_2", "scale": 0.1, "radius": 0.3})
        if round_ > 0:
            s.edit(op="orientation", orientation="auto" if round_ == 1 else [{"at": [5, 2, 3], "frame": [0.92, 0.1, 0, 0.38]}])
        s.edit(op="faces", faces=(60, 200, 500)[round_])
        state, _, proxy = finished(s, folder)
        command = state["command"]
        check("the proxy is proven", (state["proxy"]["verdict"] or {}).get("answer") == "proven", state["proxy"])
        s.post("/api/mesh")
        asked = s.state()["proxy"]
        check("a proxy that is there is not made again", (asked["step"], asked["number"]) == ("ready", state["proxy"]["number"]), asked)
        check("the command names the files", command.endswith("-o proxy.glb") and "bpscale rules.json" in command, command)
        check("the proxy has the bytes of the command line", by_command_line(command, folder) == proxy, command)
        check("the closing has the voxels of the command line", voxels_of(folder) == state["closing"]["voxels"], state["closing"])
    other = Served("served.obj", "--resolution", "96", "--rules", "rules.json", "--show", "closed.bpv", cwd=folder)
    other.enter()
    other.wait(lambda q: q["closing"]["shown"] == q["design"]["revision"])
    surface = live_surface(s)
    check("the surface that follows steps is that of the command line's closing", surface == shown_surface(other, 0) and surface[0] > 0, surface[0])
    check("the surface of saved rules is the same", surface == live_surface(other))
    other.end()
    os.remove(f"{folder}/closed.bpv")


def from_box(p, low, high):
    """The distance of a point from the surface of a box."""
    beyond = math.dist(p, [min(max(x, a), b) for x, a, b in zip(p, low, high)])
    return beyond or min(min(x - a, b - x) for x, a, b in zip(p, low, high))


def distances(folder):
    """Distances that colour a proxy, against those from the boxes of the scene; and the proxy stays the same surface."""
    os.makedirs(f"{folder}/made", exist_ok=True)
    line = "bpvox served.obj --resolution 64 | bpclose -s 5% | tee made/closed.bpv | bpmesh --faces 100 -o made/proxy.glb --overwrite"
    subprocess.run(["bash", "-c", "set -o pipefail; " + line], cwd=folder, check=True, stderr=subprocess.DEVNULL)
    s = Served("served.obj", "--resolution", "20", "--show", "made", cwd=folder)
    s.enter()
    state = s.state()
    check("a folder is its meshes and streams", [layer["name"] for layer in state["layers"]] == ["made/closed.bpv", "made/proxy.glb"], state["layers"])
    check("a file tells what it claims", state["layers"][1]["contract"] == "encloses" and state["layers"][1]["step"] == "none", state["layers"])
    check("voxels are not proven", s.ask("POST", "/api/check", '{"file": 0}')[0] == 400)

    def mesh(query):
        status, _, data = s.ask("GET", "/api/layer?" + query)
        check("a file is sent", status == 200, query, data[:200])
        counts = struct.unpack_from("<6I", data)
        at = 24
        positions = [tuple(x + m for x, m in zip(p, state["scene"]["middle"])) for p in struct.iter_unpack("<3f", data[at:at + 12 * counts[0]])]
        at += 12 * counts[0] + 4 * counts[1]
        corners = list(struct.iter_unpack("<3I", data[at:at + 12 * counts[2]]))
        at += 12 * counts[2] + 8 * counts[3]
        check("a mesh has the length that it tells", len(data) == at + 4 * counts[4], counts, len(data))
        return positions, corners, [d for d, in struct.iter_unpack("<f", data[at:])], counts[5]

    def area(positions, corners):
        total = 0
        for t in corners:
            a, b, c = (positions[v] for v in t)
            u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
            total += math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2
        return total

    plain, fine = mesh("file=1"), mesh("file=1&distances=1")
    check("without distances none are sent", plain[2] == [] and len(plain[1]) <= 100, len(plain[1]))
    check("a refined proxy tells the faces of its file", plain[3] == fine[3] == len(plain[1]), plain[3], fine[3])
    check("a refined proxy has the same area", abs(area(*fine[:2]) / area(*plain[:2]) - 1) < 1e-5, area(*fine[:2]), area(*plain[:2]))
    longest = max(math.dist(fine[0][t[k]], fine[0][t[k - 1]]) for t in fine[1] for k in range(3))
    check("a refined proxy has short edges", longest <= 2 * state["scene"]["voxel"] and len(fine[1]) < 600000, longest, len(fine[1]))
    edges = {}
    for t in fine[1]:
        for k in range(3):
            edges[t[k - 1], t[k]] = edges.get((t[k - 1], t[k]), 0) + 1
    check("a refined proxy has no crack", all(n == 1 and (b, a) in edges for (a, b), n in edges.items()))
    for positions, _, far, _ in (fine, mesh("file=0&distances=1")):
        for i in random.Random(2).sample(range(len(far)), 400):
            wanted = min(from_box(positions[i], *box) for box in comb_boxes())
            check("a distance is that from the scene", abs(far[i] - wanted) < 1e-5, positions[i], far[i], wanted)
    for _ in range(2):  # a file can be proven again
        s.post("/api/check", {"file": 1})
        state = s.wait(lambda q: q["layers"][1]["step"] in ("done", "failed"))
    verdict = state["layers"][1]["verdict"]
    check("bpcheck proves the file", verdict and verdict["answer"] == "proven", state["layers"][1])
    check("the farthest distance is within its bound", max(fine[2]) <= verdict["levels"][0]["farthest"] * 1.0001, max(fine[2]), verdict)
    s.end()


def refusals(folder):
    """A file with more than the page draws, and one that does not keep what it claims."""
    line = "bpvox served.obj --resolution 900 -q -o many.bpv && sed 's/^v \\([^ ]*\\)/v 0.5/' served.obj > flat.obj"
    subprocess.run(["bash", "-c", line], cwd=folder, check=True)
    s = Served("served.obj", "--resolution", "20", "--show", "many.bpv", "--show", "flat.obj", cwd=folder)
    s.enter()
    status, _, answer = s.ask("GET", "/api/layer?file=0")
    check("a file of too many triangles is refused, and says why", status == 413 and b"many.bpv" in answer and b"triangles" in answer, status, answer[:300])
    s.post("/api/check", {"file": 1})
    verdict = s.wait(lambda q: q["layers"][1]["step"] in ("done", "failed"))["layers"][1]["verdict"]
    check("each level tells its answer", verdict["answer"] == "refuted" and [level["answer"] for level in verdict["levels"]] == ["refuted"], verdict)
    s.end()


def memory(folder):
    """The surface is made in parts when a page asks: it takes no memory in proportion to its faces."""
    s = Served("served.obj", "--resolution", "700", "--memory", "160M", cwd=folder)
    s.enter()
    s.edit(op="live", live=False)
    s.post("/api/stop")
    s.wait(lambda q: q["closing"]["shown"] == q["design"]["revision"])
    pages = [threading.Thread(target=lambda: s.ask("GET", "/api/surface?after=0")) for _ in range(2)]
    for page in pages:
        page.start()
    for page in pages:
        page.join()
    with open(f"/proc/{s.process.pid}/status") as file:
        peak = next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) / 1024
    check("bpview keeps to --memory", peak <= 160, f"{peak:.0f} MiB")
    s.end()


def ends_while_it_starts(folder):
    """Nobody writes to the pipe in place of the scene: bpvox waits for it, or, once it has read it, the page's reader."""
    os.mkfifo(f"{folder}/slow.stl")
    with open(f"{folder}/served.obj") as file:
        points = [line.split()[1:] for line in file if line.startswith("v ")]
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {' '.join(p)}\n" for p in points[i:i + 3]) + "endloop\nendfacet\n" for i in range(0, 54, 3))
    for fed in (False, True):
        process = subprocess.Popen(["bpview", "--no-open", "slow.stl", "--resolution", "20"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if fed:
            with open(f"{folder}/slow.stl", "w") as pipe:
                pipe.write(f"solid s\n{facets}endsolid s\n")
        time.sleep(1)
        check("it waits for the scene", process.poll() is None, fed, process.poll())
        begin = time.time()
        process.send_signal(signal.SIGTERM)
        try:
            said = process.communicate(timeout=10)
            check("SIGTERM ends it at once", process.returncode == -signal.SIGTERM and time.time() - begin < 2, fed, process.returncode, time.time() - begin, said)
        except subprocess.TimeoutExpired:
            check("SIGTERM ends it", False, fed)
            process.kill()


def main():
    folder = sys.argv[1]
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    comb(f"{folder}/served.obj")
    s = Served("served.obj", "--resolution", "96", "--faces", "200", cwd=folder)
    who_gets_in(s)
    what_is_asked(s)
    slow_clients(s)
    same_bytes(s, folder)
    with open(f"{folder}/rules.json") as file:
        rules = file.read()
    code, said = s.end()
    check("Ctrl-C ends it in good order", code == 0, code, said)
    check("nothing stays behind", sorted(os.listdir(folder)) == ["proxy.glb", "rules.json", "served.obj"], os.listdir(folder))

    s = Served("served.obj", "--resolution", "96", cwd=folder)  # rules.json is there, and was not named
    s.enter()
    for what in ("rules", "proxy"):
        s.wait(lambda q: q["proxy"]["step"] == "ready")
        check("a file that is there stays", s.ask("POST", "/api/save", json.dumps({"what": what}))[0] == 400, what)
    s.edit(op="faces", faces=300)
    s.post("/api/stop")
    s.process.kill()
    s.process.communicate()
    s = Served("served.obj", "--resolution", "96", "--rules", "rules.json", cwd=folder)
    s.enter()
    s.post("/api/save", {"what": "rules"})
    with open(f"{folder}/rules.json") as file:
        check("a design goes on from its rules", file.read() == rules)
    listener = socket.create_connection(("127.0.0.1", s.port))
    listener.send(f"GET /api/events HTTP/1.1\r\nHost: 127.0.0.1:{s.port}\r\nCookie: {s.cookie}\r\n\r\n".encode())
    check("events tell the state", b"data: {" in listener.recv(1 << 16) + listener.recv(1 << 16))
    begin = time.time()
    code, said = s.end(signal.SIGTERM)
    check("it ends while a page listens", code == 0 and time.time() - begin < 8, code, time.time() - begin)
    left = subprocess.run(["pgrep", "-f", "/proc/self/fd/"], capture_output=True, text=True).stdout
    check("no tool is left", left == "", left)
    distances(folder)
    refusals(folder)
    memory(folder)
    ends_while_it_starts(folder)
    left = subprocess.run(["pgrep", "-f", "slow.stl"], capture_output=True, text=True).stdout
    check("no tool waits for a scene", left == "", left)
    sys.exit(failed > 0)


main()
