# The generated plant is the same on every machine, in both formats, and by pipe.
try bp-plant --triangles 20000 -o plant.ply
try bp-plant --triangles 200000 --seed 7 -o plant.glb
sha256sum plant.ply plant.glb
bp-plant --triangles 20000 | cmp - plant.ply
