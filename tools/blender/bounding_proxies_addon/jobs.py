"""Work that runs beside Blender: steps on a thread, and the tools that they start. Nothing here touches Blender's data."""
from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import threading
from pathlib import Path
from typing import Callable

# A tool ends some milliseconds after SIGINT. One that does not is killed after this many seconds.
GRACE_SECONDS = 5.0


class ToolError(Exception):
    """A tool failed. The message is the tool's own."""


class Cancelled(Exception):
    """The user pressed Esc."""


class Job:
    """Steps on a thread of their own, in a folder of their own.

    `work` is called with the job. It starts tools with `run()`, and what it returns is `result`. Poll `done`; then either `error` is set,
    or `cancelled`, or `result`. `close()` removes the folder.
    """

    def __init__(self, work: Callable[[Job], object]) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="bounding-proxies-"))
        self.notes: list[str] = []
        self.progress = ("", 0, 0)  # the name of the pass, how much is done, and of how much; 0: not known
        self.result: object = None
        self.error: str | None = None
        self.cancelled = False
        self._work = work
        self._stop = threading.Event()
        self._process: subprocess.Popen | None = None
        self._lock = threading.Lock()
        self._thread = threading.Thread(target=self._main, daemon=True)

    def start(self) -> None:
        self._thread.start()

    @property
    def done(self) -> bool:
        return not self._thread.is_alive()

    def wait(self, seconds: float | None = None) -> None:
        self._thread.join(seconds)

    def close(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)

    def cancel(self) -> None:
        """Ends the tool that runs with SIGINT, as Ctrl-C does. It removes what it has begun to write."""
        with self._lock:
            self._stop.set()
            process = self._process
        if process is None or process.poll() is not None:
            return
        if os.name == "nt":  # Windows sends no SIGINT to a process without a console
            process.terminate()
            return
        process.send_signal(signal.SIGINT)
        threading.Timer(GRACE_SECONDS, _kill, [process]).start()

    def check(self) -> None:
        """Ends the work here if it was cancelled."""
        if self._stop.is_set():
            raise Cancelled

    def run(self, command: list[str], answers: tuple[int, ...] = (0,)) -> str:
        """Runs a tool in the job's folder, and returns its standard output. An exit status that is none of `answers` is a ToolError with what
        the tool says. Notes are kept."""
        tool = Path(command[0]).stem
        self.progress = (f"{tool}: starting", 0, 0)
        flags = {"creationflags": subprocess.CREATE_NO_WINDOW} if os.name == "nt" else {}
        with self._lock:
            self.check()
            try:
                process = subprocess.Popen(command, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, text=True, encoding="utf-8", errors="replace", **flags)
            except OSError as e:
                raise ToolError(f"{command[0]}: {e.strerror}") from e
            self._process = process
        said: list[str] = []
        listener = threading.Thread(target=self._listen, args=(process, said), daemon=True)
        listener.start()
        output = process.stdout.read()
        process.wait()
        listener.join()
        process.stdout.close()
        process.stderr.close()
        self.check()
        notes, others = sort_words(tool, said)
        if process.returncode not in answers:
            raise ToolError(" ".join(others) or f"{tool} ended with {process.returncode}")
        self.notes += notes
        return output

    def _main(self) -> None:
        try:
            self.result = self._work(self)
        except Cancelled:
            self.cancelled = True
        except ToolError as e:
            self.error = str(e)
        except Exception as e:  # anything unforeseen must reach the user, too: nobody sees what a thread raises
            self.error = f"{type(e).__name__}: {e}"

    def _listen(self, process: subprocess.Popen, said: list[str]) -> None:
        for line in process.stderr:
            if not line.startswith("{"):
                said.append(line.rstrip("\n"))
                continue
            try:
                step = json.loads(line)
                self.progress = (f"{step['tool']}: {step['pass']}", step["done"], step["total"])
            except (ValueError, KeyError):
                said.append(line.rstrip("\n"))


def sort_words(tool: str, lines: list[str]) -> tuple[list[str], list[str]]:
    """Returns the notes of a tool, and its other lines, without its name. Where the files are is of no interest."""
    notes, others = [], []
    for line in lines:
        text = re.sub(rf"^{re.escape(tool)}: ", "", line).strip()
        if text.startswith("note: "):
            notes.append(text[len("note: "):])
        elif text and not text.startswith("the files are in "):
            others.append(text)
    return notes, others


def _kill(process: subprocess.Popen) -> None:
    if process.poll() is None:
        process.kill()
