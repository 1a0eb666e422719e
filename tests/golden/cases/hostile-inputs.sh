# Inputs that once crashed a tool, kept it busy, or got a wrong answer. Each ends soon, with one line and nothing left.
bugs=$BP_ROOT/tests/data/bugs
ask() { try timeout 60 "$@"; }
cp "$bugs"/*.* .
files > before
# Streams that are well formed, with checksums that fit, and headers that cannot be.
for stream in header_brick_box header_far_origin header_whole_range; do
  ask bpinfo $stream.bpv
  ask bpmesh $stream.bpv --faces 100,20 --error 2vx -o o.ply
  ask bpclose $stream.bpv --scale 1vx -o o.bpv
done
# What a reader refuses, no tool makes.
write_cube cube.obj
ask bpvox cube.obj --voxel 1e102% -o o.bpv
ask bpvox cube.obj --voxel 1e-38% -o o.bpv
ask bpvox cube.obj --voxel 5.8e30% -q -o o.bpv && ask bpmesh o.bpv --faces 100,20 --error 2vx -q -o o.ply
rm o.bpv o.0.ply o.1.ply
# Little in a wide grid.
printf 'v 0 0 0\nv .001 0 0\nv 0 .001 0\nv 1 1 1\nv .999 1 1\nv 1 .999 1\nf 1 2 3\nf 4 5 6\n' > corners.obj
for fill in flood winding; do
  ask bpvox corners.obj --voxel 0.00096225% --fill $fill -j 1 --memory 128M -o o.bpv --overwrite
done
rm o.bpv corners.obj cube.obj
# Counts that no data stand behind.
ask bpinfo count_sparse.gltf
ask bpinfo count_instances.gltf
# Coordinates beyond the range of the exact predicates in doubles: outside by 4e-91; inside by 5e-324; and 2e90 away.
ask bpcheck tiny_outside.obj tiny_proxy.obj
ask bpcheck denormal_inside.off denormal_proxy.ply
ask bpcheck huge_beside.obj huge_proxy.ply
# An importer that would go on for ever.
try timeout 600 bpvox busy.smd --resolution 1 -o o.bpv
# What is finite is not left out: no proxy is made of a scene without its farthest vertex.
try bpvox huge_beside.obj --resolution 8 -o o.bpv
try bplod huge_beside.obj --resolution 8 -q -o o
files | diff before - && echo "nothing left behind"
