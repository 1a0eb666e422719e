#!/usr/bin/env python3
"""Calls that run at once, are told of, are ended early, and leave nothing behind."""
import contextlib
import gc
import io
import multiprocessing
import os
import resource
import signal
import subprocess
import sys
import threading
import time
import unittest
from ctypes import byref, c_void_p
from unittest import mock

from scenes import np, soup, torus

import bounding_proxies as bp
from bounding_proxies import _library


def resident():
    """Bytes of memory of this process."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


class Runs(unittest.TestCase):
    def test_eight_threads_at_once_give_the_same_bytes(self):
        scenes = [torus(24, 12), soup(150, 2), torus(30, 14, 2, 0.4), soup(200, 3)]
        wanted = [bp.proxy(*s, faces=200, scale="3%", resolution=64).vertices for s in scenes]
        wrong = []

        def work(i):
            for turn in range(2):
                k = (i + turn) % len(scenes)
                mesh = bp.proxy(*scenes[k], faces=200, scale="3%", resolution=64, threads=1 + i % 3)
                if not np.array_equal(mesh.vertices, wanted[k]) or not bp.check(mesh, scenes[k], distances=False):
                    wrong.append((i, k))
                try:  # errors of one thread are no other's
                    bp.proxy(scenes[k][0], scenes[k][1], scale=f"{i}x")
                except bp.Error as e:
                    if f"{i}x" not in str(e):
                        wrong.append(str(e))

        threads = [threading.Thread(target=work, args=(i,)) for i in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_one_grid_serves_several_threads(self):
        grid = bp.voxelize(*torus(), resolution=96)
        wanted = grid.close("3%").mesh(200).vertices
        found = []
        threads = [threading.Thread(target=lambda: found.append(grid.close("3%").mesh(200).vertices)) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(found), 4)
        self.assertTrue(all(np.array_equal(f, wanted) for f in found))

    def test_progress_is_told_on_the_callers_thread(self):
        heard, here = [], threading.get_ident()

        def progress(name, done, total):
            self.assertEqual(threading.get_ident(), here)
            heard.append((name, done, total))

        bp.proxy(*torus(200, 100), faces=500, scale="3%", resolution=200, progress=progress)
        self.assertGreaterEqual(len({name for name, _, _ in heard}), 2)

    def test_a_bar_without_tqdm_is_a_line_of_text_that_goes_away(self):
        said = io.StringIO()
        with mock.patch.dict(sys.modules, {"tqdm.auto": None}), contextlib.redirect_stderr(said):
            bp.proxy(*torus(200, 100), faces=500, scale="3%", resolution=200, progress=True)
        lines = said.getvalue().split("\r")
        self.assertTrue(any(line.rstrip().endswith(" %") for line in lines), lines)
        self.assertEqual((lines[-2].strip(), lines[-1]), ("", ""))

    def end_early(self, progress, kind):
        begin = time.monotonic()
        with self.assertRaises(kind):
            bp.proxy(*torus(400, 300), faces=2000, scale="6%", resolution=700, progress=progress)
        return time.monotonic() - begin

    def test_progress_ends_a_call(self):
        self.end_early(lambda name, done, total: True, bp.CancelledError)

        def fails(name, done, total):
            raise KeyError("mine")

        self.end_early(fails, KeyError)
        self.assertTrue(bp.proxy(*torus(24, 12), faces=200, resolution=48).vertices.size)  # goes on working

    def test_a_call_ends_in_each_of_its_steps(self):
        slowest = 0.0
        for step in (0.02, 0.2, 0.5, 1.0, 1.5, 2.5, 4.0):
            signal.signal(signal.SIGALRM, signal.default_int_handler)
            signal.setitimer(signal.ITIMER_REAL, step)
            begin = time.monotonic()
            try:
                bp.proxy(*torus(400, 300), faces=2000, scale="4%", resolution=300)
                bp.levels(*torus(400, 300))
                signal.setitimer(signal.ITIMER_REAL, 0)
                break
            except KeyboardInterrupt:  # as of Ctrl-C
                slowest = max(slowest, time.monotonic() - begin - step)
        print(f"longest wait for an end: {slowest:.3f} s", file=sys.stderr)
        self.assertLess(slowest, 5)

    def in_children(self, work):
        """Calls work() in two children of fork() at once. Returns what it returned there."""
        context = multiprocessing.get_context("fork")
        answers = context.SimpleQueue()
        children = [context.Process(target=lambda: answers.put(work())) for _ in range(2)]
        for child in children:
            child.start()
        for child in children:
            child.join(120)
            if child.exitcode is None:
                child.kill()
            self.assertEqual(child.exitcode, 0)
        return [answers.get() for _ in children]

    def test_calls_go_on_in_children_of_fork(self):
        scene = torus(40, 20)
        grid = bp.voxelize(*scene, resolution=64)
        wanted = grid.close("3%").mesh(200).vertices

        def work():
            mesh = bp.proxy(*scene, faces=200, scale="3%", resolution=64, threads=2)
            return [mesh.vertices, grid.close("3%").mesh(200).vertices, bp.check(mesh, scene).answer]

        for mesh, of_grid, answer in self.in_children(work):
            self.assertTrue(np.array_equal(mesh, wanted) and np.array_equal(of_grid, wanted))
            self.assertEqual(answer, "proven")
        self.assertTrue(np.array_equal(grid.close("3%").mesh(200).vertices, wanted))

    def test_a_fork_during_a_call_of_another_thread_is_told(self):
        begun, stopped = threading.Event(), threading.Event()

        def progress(name, done, total):
            begun.set()
            return stopped.is_set()

        def call():
            with self.assertRaises(bp.CancelledError):
                bp.proxy(*torus(400, 300), faces=2000, scale="6%", resolution=700, progress=progress)

        def work():
            try:
                return len(bp.proxy(*torus(24, 12), faces=200, resolution=48).triangles)
            except bp.FailedError as e:
                return str(e)

        other = threading.Thread(target=call)
        other.start()
        begun.wait(60)
        answers = self.in_children(work)
        stopped.set()
        other.join()
        for answer in answers:
            self.assertRegex(str(answer), "forked while another thread was in a call of libbp; fork when no call runs")

    def test_memory_returns(self):
        vertices, triangles = torus(24, 12)

        def turn():
            grid = bp.voxelize(vertices, triangles, resolution=32).close("4%")
            mesh = grid.mesh(100)
            bp.levels(vertices, triangles, 60, levels=1, resolution=24)
            bp.check(mesh, (vertices, triangles), distances=False)
            grid.dense()
            try:
                bp.proxy(vertices, triangles, scale="no length")
            except bp.Error:
                pass

        for _ in range(40):
            turn()
        gc.collect()
        before = resident()
        for _ in range(2000 if os.environ.get("BP_ALL") else 120):  # of six calls
            turn()
        gc.collect()
        print(f"resident: {before >> 10} KiB before, {resident() >> 10} KiB after", file=sys.stderr)
        self.assertLess(resident() - before, 24 << 20)

    def test_arrays_outlive_their_mesh(self):
        vertices = bp.proxy(*torus(24, 12), faces=200, resolution=48).vertices
        copy = vertices.copy()
        gc.collect()
        bp.proxy(*torus(30, 20), faces=300, resolution=64)
        self.assertTrue(np.array_equal(vertices, copy))
        with self.assertRaises(ValueError):
            vertices[0, 0] = 1

    def test_structs_of_other_versions(self):
        lib = _library.lib()
        options = _library.VoxelizeOptions.made()
        scene = bp.Scene(*torus(24, 12))
        out = c_void_p()
        options.size = 8  # knows nothing but its size: all is default
        options.resolution = -7
        self.assertEqual(lib.bp_voxelize(scene._handle.address, byref(options), None, byref(out)), 0)
        lib.bp_grid_free(out)
        longer = np.zeros(32, np.uint64)
        longer[0] = longer.nbytes
        self.assertEqual(lib.bp_voxelize(scene._handle.address, longer.ctypes.data, None, byref(out)), 0)
        lib.bp_grid_free(out)
        longer[-1] = 1
        self.assertEqual(lib.bp_voxelize(scene._handle.address, longer.ctypes.data, None, byref(out)), 2)
        self.assertIn(b"does not know", lib.bp_error_message())
        longer[0] = 3
        self.assertEqual(lib.bp_voxelize(scene._handle.address, longer.ctypes.data, None, byref(out)), 2)

    def test_null_is_refused(self):
        lib = _library.lib()
        out = c_void_p()
        for status in (lib.bp_scene_from_arrays(None, None, byref(out)), lib.bp_voxelize(None, None, None, byref(out)),
                       lib.bp_close(None, None, None, byref(out)), lib.bp_mesh_make(None, None, None, byref(out)),
                       lib.bp_mesh_look(None, 0, None, 0), lib.bp_check_mesh(None, 0, None, None, None, byref(out)),
                       lib.bp_levels(None, None, None, None, byref(out)), lib.bp_occluder(None, None, None, None, byref(out)),
                       lib.bp_scene_cage(None, None, None, None, byref(out)), lib.bp_levels_save(None, None, None, 0),
                       lib.bp_grid_load(None, None, byref(out)), lib.bp_length_parse(None, None), lib.bp_voxelize(None, None, None, None)):
            self.assertEqual(status, 2)
            self.assertIn(b"NULL", lib.bp_error_message())
        for name in ("scene", "grid", "mesh", "verdict", "weights", "stop"):
            getattr(lib, f"bp_{name}_free")(None)

    def test_the_library_prints_nothing(self):
        code = "import bounding_proxies as bp\nfrom scenes import torus\nbp.check(bp.proxy(*torus(24, 12), faces=4, scale='9%', resolution=48), torus(24, 12))"
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, cwd=os.path.dirname(os.path.abspath(__file__)))
        self.assertEqual((run.stdout, run.stderr), (b"", b""))


if __name__ == "__main__":
    unittest.main()
