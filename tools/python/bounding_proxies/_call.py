"""Long calls of the library: Ctrl-C ends them, progress is told on the caller's thread, and the GIL is free meanwhile."""
import difflib
import inspect
import sys
import threading
from ctypes import byref, c_void_p

from ._library import ERRORS, ArgumentError, FailedError, Handle, Note, Progress, Run, lib, path_bytes, size, text, whole

POLL_SECONDS = 0.05


class Options:
    """How calls run. Every function that takes long takes these arguments, by name; this class only documents them.

    threads   at most so many; 0: one for each core
    memory    bytes to keep below, or a text such as "4G"; 0: a quarter of the machine's. What does not fit waits in `temp`
    temp      folder for what waits; None: $TMPDIR, else /tmp
    device    "auto", "cpu", "cuda" or "cuda:0,1"
    progress  called now and then as progress(name_of_work, done, total), on the caller's thread. total is 0 if it is not known. True
              ends the call with CancelledError. progress=True shows a bar of tqdm where that is installed, else a line of
              text on stderr
    """

    def __init__(self, threads=0, memory=0, temp=None, device=None, progress=None, **unknown):
        for name in unknown:
            _refuse_keyword(name, inspect.currentframe().f_back.f_code)
        if device is not None and not isinstance(device, str):
            raise ArgumentError(f"device: {device!r} is no text such as 'cpu' or 'cuda:0'")
        if progress is not None and progress is not True and not callable(progress):
            raise ArgumentError(f"progress: {progress!r} is no function; give one, or True to see a bar")
        self.threads, self.memory, self.temp, self.device = whole(threads, "threads"), size(memory, "memory"), temp, device
        self.progress = _Bar() if progress is True else progress


def _refuse_keyword(name, code):
    """Raises a TypeError, as Python does for functions without `run`. `code`: of the function that was called."""
    options = [n for n in inspect.signature(Options).parameters if n != "unknown"]
    if code.co_name == "<module>" or "run" not in code.co_varnames:  # Options itself
        function, known = "Options", options
    else:
        function, known = code.co_name, [n for n in code.co_varnames[:code.co_argcount + code.co_kwonlyargcount] if n != "self"] + options
    near = difflib.get_close_matches(name, known, 1)
    hint = f"did you mean {near[0]!r}?" if near else "it has " + ", ".join(known)
    raise TypeError(f"{function}() got an unexpected keyword argument {name!r}; {hint}")


class _Bar:
    """Shows progress: by a bar of tqdm for each pass, else in a line of text on stderr."""

    def __init__(self):
        try:
            from tqdm.auto import tqdm
        except ImportError:
            tqdm = None
        self._tqdm, self._name, self._bar, self._width = tqdm, None, None, 0

    def __call__(self, name, done, total):
        if self._tqdm is None:
            line = f"{name} {100 * done // total} %" if total else name
            print(f"\r{line:<{self._width}}", end="", file=sys.stderr, flush=True)
            self._width = len(line)
            return
        if self._name != name:
            self.close()
            self._name, self._bar = name, self._tqdm(desc=name, leave=False)
        self._bar.total, self._bar.n = total or None, done
        self._bar.refresh()

    def close(self):
        """Removes what is shown."""
        if self._width:
            print("\r" + " " * self._width, end="\r", file=sys.stderr, flush=True)
        if self._bar is not None:
            self._bar.close()
        self._bar, self._width = None, 0


class _Job:
    """One call on a thread of its own."""

    def __init__(self, options):
        self.stop = lib().bp_stop_new()
        self.notes, self.latest, self.error, self.result = [], {}, None, None
        self.done = threading.Event()
        run = Run.made()
        run.threads, run.memory, run.stop = options.threads, options.memory, self.stop
        run.temp = None if options.temp is None else path_bytes(options.temp, "temp")
        run.device = None if options.device is None else text(options.device, "device")
        # Callbacks of ctypes live as long as this object.
        self._note = Note(lambda _, text: self.notes.append(text.decode(errors="replace")))
        run.note = self._note
        if options.progress is not None:
            self._progress = Progress(self._hear)
            run.progress = self._progress
        self.run = run

    def _hear(self, _, name, unit, done, total):
        self.latest[name.decode()] = (done, total)
        return 0

    def work(self, function, arguments, free):
        try:
            out = c_void_p()
            results = (byref(out),) if free else ()
            status = getattr(lib(), function)(*arguments(byref(self.run)), *results)
            if status != 0:  # the message belongs to this thread
                self.error = ERRORS.get(status, FailedError)(lib().bp_error_message().decode(errors="replace"))
            elif free:
                self.result = Handle(out.value, free)
        except BaseException as e:
            self.error = e
        finally:
            self.done.set()

    def tell(self, progress):
        """Tells of the passes since it was last called, in their order."""
        latest, self.latest = self.latest, {}
        for name, (done, total) in list(latest.items()):  # _hear() may still add to it
            if progress(name, done, total):
                lib().bp_stop_set(self.stop)

    def wait(self, progress):
        try:
            while not self.done.wait(POLL_SECONDS):
                if progress is not None:
                    self.tell(progress)
            if progress is not None and self.error is None:
                self.tell(progress)
        except BaseException:  # Ctrl-C, or an error of the caller's progress
            lib().bp_stop_set(self.stop)
            while not self.done.is_set():  # the call uses the caller's arrays until its end
                try:
                    self.done.wait()
                except KeyboardInterrupt:  # of an impatient user; the first is raised
                    pass
            raise

    def __del__(self):
        if self.stop:
            lib().bp_stop_free(self.stop)


def call(options, function, arguments, free=None):
    """Calls a function of the library. `arguments` gets the bp_run and returns all arguments but the result's. `free`: the function that
    frees the result; None: there is none. Returns the result's handle and the notes."""
    job = _Job(options)
    if options.progress is None and threading.current_thread() is not threading.main_thread():
        job.work(function, arguments, free)
    else:
        threading.Thread(target=job.work, args=(function, arguments, free), daemon=True).start()
        try:
            job.wait(options.progress)
        finally:
            if isinstance(options.progress, _Bar):
                options.progress.close()
    if job.error is not None:
        raise job.error
    return job.result, job.notes
