"""Proofs of proxies."""
import json
from ctypes import byref

from ._call import Options, call
from ._library import CheckOptions, VerdictInfo, length, lib, read_struct
from ._mesh import Mesh, load
from ._scene import arrays_of, is_path, mesh_arrays, scene_of

ANSWERS = ("proven", "refuted", "undecided")


class Verdict:
    """What check() found. It is true if all that was asked is proven.

    holds     whether all that was asked is proven
    answer    "proven", "refuted" or "undecided", of all that was asked
    sound     the same of the mesh alone: closed, oriented, embedded, 2-manifold
    placed    the same of its place: it encloses the scene, or lies inside it
    reasons   what does not hold, in a few words; "" if all holds
    touching, outside                numbers of triangles of the scene that touch the proxy, or lie outside
    volume, scene_volume             scene units cubed; nan: not closed, or not known
    scene_to_proxy, proxy_to_scene   the largest distance seen, scene units; nan: not measured
    text      the lines that bpcheck prints
    json      what bpcheck --json prints, as a dict
    """

    def __init__(self, handle, notes):
        self.notes = list(notes)
        i = read_struct(VerdictInfo, "bp_verdict_read_info", handle.address)
        self.answer, self.sound, self.placed = ANSWERS[i.answer], ANSWERS[i.sound], ANSWERS[i.placed]
        self.holds = self.answer == "proven"
        self.touching, self.outside, self.volume, self.scene_volume = i.touching, i.outside, i.volume, i.scene_volume
        self.scene_to_proxy, self.proxy_to_scene = i.scene_to_proxy, i.proxy_to_scene
        self.reasons = lib().bp_verdict_reasons(handle.address).decode()
        self.text = lib().bp_verdict_text(handle.address).decode()
        self.json = json.loads(lib().bp_verdict_json(handle.address))

    def __bool__(self):
        return self.holds

    def __repr__(self):
        return f"<bounding_proxies.Verdict: {self.answer}{': ' * bool(self.reasons)}{self.reasons}>"


def check(proxy, scene=None, *, inside=False, convex=False, margin=None, distances=True, **run):
    """Proves or refutes that a proxy is a closed, oriented, embedded 2-manifold and strictly encloses every triangle of a scene.

    proxy      a Mesh, (vertices, triangles), a path (of a file with levels, the finest), or an object as Scene takes
    scene      what Scene takes; None: only the mesh is asked about
    inside     the proxy is to lie inside the scene, not around it; a Mesh, or a file, also tells how openings were closed
    convex     the proxy is a union of convex parts that may overlap
    margin     the proxy is to keep this distance from the scene: a number in scene units, or "1%"
    distances  measure distances between both, which takes most of the time
    run        threads, memory, temp, progress (Options)
    Returns a Verdict. Exact for the doubles as given. Cost: linear in the scene, times log of the proxy.
    """
    options = CheckOptions.made()
    options.inside, options.convex, options.no_distances = bool(inside), bool(convex), not distances
    options.margin = length(margin, "margin")
    against = None if scene is None else scene_of(scene, copy=False)
    address = None if against is None else against._handle.address
    how = Options(**run)
    if is_path(proxy):
        proxy = load(proxy, **run)[0]
    if isinstance(proxy, Mesh):
        return Verdict(*call(how, "bp_check_mesh", lambda r: (proxy._handle.address, proxy._index, address, byref(options), r),
                             "bp_verdict_free"))
    pair = mesh_arrays(proxy)
    if pair is None:
        raise TypeError(f"{type(proxy).__name__} is no mesh: give a Mesh, (vertices, triangles), a path, or an object with .vertices and .faces")
    arrays, kept = arrays_of(*pair)
    return Verdict(*call(how, "bp_check", lambda r, _=kept: (byref(arrays), address, byref(options), r), "bp_verdict_free"))
