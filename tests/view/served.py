"""bpview under test: started on a scene, talked to over HTTP, ended by SIGINT."""
import http.client, json, os, re, signal, subprocess, time


def comb_boxes(teeth=6):
    return [((0, 0, 0), (10, 1, 6))] + [((i * 1.6, 1, 0), (i * 1.6 + 0.7, 4, 3)) for i in range(teeth)]


def comb(path):
    """A plate with teeth: closings of larger scales fill the gaps between them."""
    boxes = comb_boxes()
    with open(path, "w") as out:
        for n, (low, high) in enumerate(boxes):
            out.write(f"g part_{n}\n")
            for i in range(8):
                out.write("v " + " ".join(str((high if i >> k & 1 else low)[k]) for k in range(3)) + "\n")
            for quad in ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)):
                out.write("f " + " ".join(str(8 * n + v + 1) for v in quad) + "\n")


class Served:
    def __init__(self, *args, cwd="."):
        self.process = subprocess.Popen(["bpview", "--no-open", *args], cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.link = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/#([0-9a-f]{32})", self.link)
        assert found, (self.link, self.process.stderr.read())
        self.port, self.token = int(found[1]), found[2]
        self.origin = f"http://127.0.0.1:{self.port}"
        self.cookie = None

    def ask(self, method, path, body=None, headers={}, own=True):
        """Status, headers and body. own: Host, Origin and cookie as the page's."""
        all = {"Origin": self.origin, **({"Cookie": self.cookie} if self.cookie else {})} if own else {}
        all.update(headers)
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        connection.putrequest(method, path, skip_host="Host" in all, skip_accept_encoding=True)
        for name, value in all.items():
            connection.putheader(name, value)
        data = body.encode() if isinstance(body, str) else body
        if data is not None:
            connection.putheader("Content-Length", str(len(data)))
        connection.endheaders()
        try:
            if data:
                connection.send(data)
        except (BrokenPipeError, ConnectionResetError):
            pass  # refused before all of it was sent: the answer says so
        answer = connection.getresponse()
        result = answer.status, answer.headers, answer.read()
        connection.close()
        return result

    def enter(self):
        status, headers, _ = self.ask("POST", "/session", self.token)
        assert status == 200, status
        self.set_cookie = headers["Set-Cookie"]
        self.cookie = self.set_cookie.split(";")[0]

    def post(self, path, body={}):
        status, _, answer = self.ask("POST", path, json.dumps(body))
        assert status == 200, (path, body, status, answer)

    def edit(self, **body):
        self.post("/api/edit", body)

    def state(self):
        status, _, answer = self.ask("GET", "/api/state")
        assert status == 200, status
        return json.loads(answer)

    def wait(self, done, seconds=60):
        end = time.time() + seconds
        while time.time() < end:
            state = self.state()
            if done(state):
                return state
            time.sleep(0.02)
        raise AssertionError(("waited in vain", state["closing"], state["proxy"]))

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        said = self.process.communicate(timeout=20)[1]
        return self.process.returncode, said
