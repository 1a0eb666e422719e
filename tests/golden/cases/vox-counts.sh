# A cube of 8 voxels a side touches 10 of them: closed cubes. Threads, memory and the way in change no byte.
write_cube cube.obj
try bpvox cube.obj --voxel 0.125 -o cube.bp --report report.json
grep -E '"(triangles|voxel|surface_voxels|solid_voxels|open_columns)"' report.json
said 'bpvox cube.obj --voxel 0.125 | cmp - cube.bp'
said '[ $(bpvox - --format obj --voxel 0.125 < cube.obj | bpinfo | checksum) = $(bpinfo cube.bp | checksum) ]'
said 'bpvox cube.obj --voxel 0.125 -j 1 --memory 64M | cmp - cube.bp'
try bpvox cube.obj --voxel 0.125 --fill none -o shell.bp --report shell.json
grep solid_voxels shell.json
try bpvox cube.obj --resolution 8 --fill winding -o winding.bp --report winding.json
grep solid_voxels winding.json
# The share of the diagonal, sqrt(3), is rounded up to a short double.
try bpvox cube.obj --voxel 5% -o percent.bp --report percent.json
grep -A1 notes percent.json
# Two scenes are voxelized together.
sed 's/^v 1/v 3/; s/^v 0/v 2/' cube.obj > beside.obj
try bpvox cube.obj beside.obj --voxel 0.125 -o two.bp --report two.json
grep solid_voxels two.json
files
