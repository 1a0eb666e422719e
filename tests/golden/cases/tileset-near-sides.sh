# A scene whose corners lie close to the sides of larger voxels: its coarse levels, in one mesh, are around it all the same.
# Their voxels were taken for those of another scene.
awk 'BEGIN {
  beside = 2 / 65536  # of a voxel: more than voxels are grown by, less than larger ones are
  for (z = 0; z < 2; ++z) for (y = 0; y < 2; ++y) for (x = 0; x < 2; ++x) printf "v %.9f %.9f %.9f\n", x * (40 - beside), y * (41 - beside), z * (42 - beside)
  for (z = 0; z < 2; ++z) for (y = 0; y < 2; ++y) for (x = 0; x < 2; ++x) print "v", 240 * x, 10 * y, 10 * z
  for (k = 0; k < 16; k += 8) {
    print "f", k + 1, k + 3, k + 4, k + 2; print "f", k + 5, k + 6, k + 8, k + 7; print "f", k + 1, k + 2, k + 6, k + 5
    print "f", k + 3, k + 7, k + 8, k + 4; print "f", k + 1, k + 5, k + 7, k + 3; print "f", k + 2, k + 4, k + 8, k + 6
  }
}' > beside.obj
try bplod beside.obj --voxel 1 --up z --profile 3dtiles --levels 4 --tile 64 -j 1 -q -o tiles > /dev/null
try bpcheck beside.obj tiles/tileset.json | grep hold
try bplod beside.obj --voxel 1 --up z --levels 4 -j 1 -q -o lod > /dev/null
try bpcheck beside.obj lod/beside.glb | grep hold
rm -r tiles lod beside.obj
files
