# Levels of detail that need not enclose: sound, with normals, drawn to the closing's or the scene's surface.
printf 'v 0 0 0\nv 9 1 0\nv 2 8 1\nv 3 2 7\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' > slanted.obj
bpvox slanted.obj --resolution 60 -o slanted.bpv
try bpmesh slanted.bpv --mode fit --faces 400,60 -o fit.glb
try bpmesh slanted.bpv --mode fit --faces 60 --enclose slanted.obj -o near.obj
for proxy in fit.0.glb fit.1.glb near.obj; do bpcheck $proxy | tail -1; done
grep -c '^vn ' near.obj
grep -c '^v ' near.obj
try bpmesh slanted.bpv --mode fit --faces 60 --enclose input -o wrong.glb
try bpmesh slanted.bpv --mode fit --volume 2 -o wrong.glb
try bpmesh slanted.bpv --mode loose -o wrong.glb
files
