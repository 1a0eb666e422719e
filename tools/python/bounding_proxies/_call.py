"""Long calls of the library: Ctrl-C ends them, progress is told on the caller's thread, and the GIL is free meanwhile."""
import difflib
import inspect
import threading
from ctypes import byref, c_void_p

from ._library import ERRORS, ArgumentError, FailedError, Handle, Note, Progress, Run, lib, path_bytes, size, text, whole

POLL_SECONDS = 0.05


class Options:
    """How calls run. Every function that takes long takes these, by name.

    threads   at most so many; 0: one for each core
    memory    bytes to keep below, or a text such as "4G"; 0: a quarter of the machine's. What does not fit waits in `temp`
    temp      folder for what waits; None: $TMPDIR, else /tmp
    device    "auto", "cpu", "cuda" or "cuda:0,1"
    progress  called now and then as progress(name_of_work, done, total), on the caller's thread. total is 0 if it is not known. True
              ends the call with CancelledError. progress=True shows a bar of tqdm where that is installed
    """

    def __init__(self, threads=0, memory=0, temp=None, device=None, progress=None, **unknown):
        for name in unknown:
            _refuse_keyword(name, inspect.currentframe().f_back.f_code)
        if device is not None and not isinstance(device, str):
            raise ArgumentError(f"device: {device!r} is no text such as 'cpu' or 'cuda:0'")
        if progress is not None and progress is not True and not callable(progress):
            raise ArgumentError(f"progress: {progress!r} is no function; give one, or True for a bar of tqdm")
        self.threads, self.memory, self.temp, self.device = whole(threads, "threads"), size(memory, "memory"), temp, device
        self.progress = _bar() if progress is True else progress


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


def _bar():
    """Returns a progress callback that draws a bar of tqdm; None without tqdm."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    shown = {}

    def show(name, done, total):
        if shown.get("name") != name:
            if "bar" in shown:
                shown["bar"].close()
            shown.update(name=name, bar=tqdm(desc=name, leave=False))
        shown["bar"].total = total or None
        shown["bar"].n = done
        shown["bar"].refresh()

    return show


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
            self.done.wait()
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
        job.wait(options.progress)
    if job.error is not None:
        raise job.error
    return job.result, job.notes
