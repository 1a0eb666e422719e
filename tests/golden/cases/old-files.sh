# What version 0.2.0 wrote is read and proven (docs/compatibility.md). The files are kept as they were.
old=$BP_ROOT/tests/data/0.2.0
for file in proxy.ply proxy.obj proxy.glb level.glb tiles/tileset.json; do try bpcheck "$old/scene.obj" "$old/$file" | grep -o "holds$"; done
try bpcheck --inside "$old/scene.obj" "$old/occluder.glb" | grep -o "holds$"
try bpinfo "$old/closed.bpv" | sed "s|$old/||" | head -5
bpmesh "$old/closed.bpv" --faces 12 -q -o again.ply
try bpcheck "$old/scene.obj" again.ply | grep -o "holds$"
try bpinfo "$old/scene.bpw" | sed "s|$old/||" | head -5
awk '$1 == "v" { $2 += 10 } 1' "$old/cage.obj" > moved.obj
bpdeform apply "$old/scene.bpw" moved.obj -q -o moved-scene.obj
grep -c ^v moved-scene.obj
head -2 moved-scene.obj
