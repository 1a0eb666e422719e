# Files that other programs read in another way, or that hold more than they promise: nothing is proven of them. Each line of the table:
# the answer that is right, the file of tests/data/bugs/readings or readings_text, and whether it is the scene or the proxy. A cube lies in each of the boxes.
bugs=$BP_ROOT/tests/data/bugs/readings
write_cube cube.obj 1
answers cube.obj readings readings_text << 'TABLE'
proven box_around.gltf proxy
undecided bounds_elsewhere.gltf proxy
undecided bounds_missing.gltf proxy
undecided hidden_proxy.gltf proxy
undecided no_scene.gltf proxy
undecided two_scenes.gltf proxy
undecided animated.gltf proxy
refused moved_by_rtc.gltf proxy
refuted restart.gltf proxy
refused x_twice_binary.ply scene
refused vertices_twice.ply scene
refused lists_twice.ply scene
refused faces_twice.ply proxy
refused more_faces.ply scene
refused more_faces_binary.ply scene
undecided more_words.ply scene
undecided goes_on_comment.obj proxy
undecided goes_on_smooth.obj proxy
undecided goes_on_material.obj proxy
undecided goes_on_vertex.obj proxy
undecided goes_on_vertex.obj scene
undecided bent_high.obj proxy
undecided f_word.obj scene
undecided lone_cr.obj scene
undecided lone_cr.ply scene
undecided lone_cr_data.ply scene
undecided lone_cr_binary.ply scene
undecided lone_cr.off scene
undecided lone_cr.stl scene
proven only_cr.obj scene
undecided joined_vertex.obj scene
undecided joined_corner.obj scene
proven goes_on_blank.obj scene
undecided glued_face.obj scene
undecided glued_vertex.obj scene
undecided facet_in_name.stl scene
undecided facet_in_end.stl scene
undecided facet_outside.stl scene
undecided four_corners.stl scene
proven no_loops.stl scene
undecided more_words.off scene
undecided more_counts.off scene
proven colors.off scene
undecided insert_turned.dxf scene
undecided insert_far.dxf scene
undecided solid.dxf scene
TABLE

# Quads that hold over either diagonal.
sed 's/^v 5 5 5/v 5 5 5.5/' around.obj > bent.obj
said 'bpcheck cube.obj bent.obj | grep -E "flat|hold"'

# Names of files that viewers cut, complete or take elsewhere. A literal file of the name lies there, and the one that a viewer opens is small.
cp "$bugs"/box_around.gltf .
python3 - << 'PY'
import base64, json, os, struct, subprocess
doc = json.load(open("box_around.gltf"))
data = base64.b64decode(doc["buffers"][0].pop("uri").split(",")[1])
small = struct.pack("<24f", *(x / 100 for x in struct.unpack_from("<24f", data))) + data[96:]
os.mkdir("s")
for plain in ("p.bin", "s/p.bin"):
    open(plain, "wb").write(small)
ANSWERS = {0: "proven", 1: "refuted", 5: "undecided", 3: "refused"}
for uri, literal in (("whole.bin", "whole.bin"), ("wh%6Fle.bin", None), ("x/../whole.bin", None), ("./s/../whole.bin?v=7#x", None),
                     ("p.bin?x", "p.bin?x"), ("p.bin#x", "p.bin#x"), ("s\\p.bin", "s\\p.bin"), (" p.bin", " p.bin"), ("p.bin ", "p.bin "),
                     ("p.b\tin", "p.b\tin"), ("p.bin%00", None), ("s%2Fp.bin", None), ("s%5Cp.bin", "s\\p.bin"), ("http:p.bin", "http:p.bin"),
                     (os.getcwd() + "/whole.bin", None), ("//host/whole.bin", None), ("p%.bin", "p%.bin"), ("", None), ("?x", None),
                     ("https://example.org/p.bin", None), ("file:whole.bin", None)):
    if literal:
        open(literal, "wb").write(data)
    doc["buffers"][0]["uri"] = uri
    json.dump(doc, open("named.gltf", "w"))
    run = subprocess.run(["bpcheck", "cube.obj", "named.gltf"], capture_output=True, text=True)
    last = run.stderr if run.returncode == 3 else run.stdout
    print("%s: %s; %s" % (json.dumps(uri.replace(os.getcwd(), "FOLDER")), ANSWERS.get(run.returncode, run.returncode), last.strip().split("\n")[-1]))
PY

# Thin slivers side by side: all their boxes are the same.
awk 'BEGIN { for (i = 0; i < 100000; ++i) { x = i * 1e-7; printf "v %.9f 0 0\nv %.9f 1 1\nv %.9f 1 1.000000001\nf -3 -2 -1\n", x, 1 + x, 1 + x } }' > slivers.obj
bpcheck slivers.obj > verdict 2> note
echo "slivers: exit $?; $(grep free verdict)"
