# A scene six million units out: 32-bit floats hold its proxy only around an origin, and bpcheck moves it back exactly.
write_cube cube.obj 3
sed 's/^v \(.*\) \(.*\) \(.*\)$/echo v $((\1 + 6000000)) $((\2 + 6000000)) \3/e' cube.obj > far.obj
bpvox far.obj --resolution 40 | bpclose --scale 2vx -o far.bpv
try bpmesh far.bpv --faces 12 -o far.stl
try bpmesh far.bpv --faces 12 --origin 6000000,6000000,0 -o far.stl
try bpmesh far.bpv --faces 12 --origin auto -o auto.stl
said 'bpcheck far.obj auto.stl --origin=6000002,6000002,2 -q | tail -1'
rm auto.stl
try bpcheck far.obj far.stl
try bpcheck far.obj far.stl --origin 6000000,6000000,0
try bpcheck far.obj far.stl --origin 6000000.1,6000000,1e-9
# Files that say that they were moved are told from those that enclose nothing.
for file in moved.glb moved.ply; do bpmesh far.bpv --faces 12 --origin 6000000,6000000,0 -q -o $file; done
for file in moved.glb moved.ply; do said "bpcheck far.obj $file | tail -1"; done
for file in moved.glb moved.ply; do said "bpcheck far.obj $file --origin=6000000,6000000,0 | tail -1"; done
bplod far.obj --voxel 0.1 --faces 12 --levels 1 --profile 3dtiles --name far -q -o tiles > list
said 'bpcheck far.obj tiles/far_LOD0.glb | tail -1'
# bplod moves its levels in the same way, and every file tells; bpcheck proves what is moved back, of numbers that are nowhere rounded.
try bplod far.obj --voxel 0.1 --faces 12 -o unmoved | cut -f 1,2
try bplod far.obj --voxel 0.1 --faces 12 -o unmoved --overwrite --origin off | cut -f 1,2
try bplod far.obj --voxel 0.1 --faces 12 --up z --origin auto -o levels --report levels.json | cut -f 1,2
tr -d ' \n' < levels.json | grep -oE '"origin":("auto"|\[[^]]*\])'
grep -ao '"origin":[^]]*]' levels/far.glb
bpinfo levels/far.glb | grep origin
bpinfo far.obj | grep bounds
bpinfo levels/far_LOD0.glb | awk '/^bounds/ { for (i = 2; i < 9; ++i) if ($i ^ 2 > 100) print "far: " $i }'
bpinfo unmoved/far_LOD0.glb | awk '/^bounds/ { print ($2 > 5e6 ? "unmoved" : "moved: " $2) }'
for file in far.glb far_LOD0.glb; do said "bpcheck far.obj levels/$file | tail -1"; done
said 'bpcheck far.obj levels/far_LOD0.glb --origin 0,0,0 | tail -1'
said 'bpcheck far.obj levels/far_LOD0.glb --origin 6000000,6000000,2 | tail -1'
said 'bpcheck levels/far_LOD0.glb | tail -1'
bplod far.obj --voxel 0.1 --profile collision --origin auto -q -o body > list
for f in godot unity; do said "bpcheck far.obj body/far_$f.glb -q | tail -1"; done
said 'bpcheck --convex far.obj body/far_unreal.glb -q | tail -1'
# A level of the same scene, moved by the same, is compared as it is.
bplod far.obj --voxel 15.4% --faces 12 -q --enclose input --origin auto -o loose > list
said 'bpcheck levels/far_LOD0.glb loose/far_LOD0.glb | tail -1'
bplod far.obj --voxel 0.1 --origin auto --explain -q | grep origin
try bpmesh far.bpv --faces 12 --origin auto -o auto.glb
said 'bpcheck far.obj auto.glb | tail -1'
try bpmesh far.bpv --faces 12 -o far.glb
try bpmesh far.bpv --faces 12 -o far.ply
# What would be rounded is refused before the work; a scene that is near is not moved; a tileset needs none.
try bplod far.obj --voxel 0.1 --origin 6000000.1,6000000,1e-9 -o x
try bplod cube.obj --voxel 0.1 --faces 12 --origin auto -o near | cut -f 1,2
try bplod cube.obj --voxel 0.1 --origin 1,2 -o x
try bplod far.obj --profile 3dtiles --origin auto -o x
files
