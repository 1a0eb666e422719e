# What the generator refuses, and that nothing stays behind.
try bp-plant --triangles 9
try bp-plant --triangles -5
try bp-plant --triangles 100000000000 -o plant.ply
try bp-plant --seed 1 --seed 2 -o plant.ply
try bp-plant --output
try bp-plant --colour red
try bp-plant surplus
try bp-plant -o missing/plant.ply
try bp-plant -o .
try bp-plant -o /dev/full
touch plant.ply
try bp-plant --triangles 10000 -o plant.ply
try bp-plant --triangles 10000 -o plant.ply --overwrite
said 'bp-plant | head -c 10 | wc -c'
said 'bp-plant --triangles 10000 > /dev/full'
said 'bp-plant --triangles 10000 >&-'
said 'bp-plant --help > /dev/full'
files
