# Cubes that are turned by several hundred rotations: what the closing really takes is no more than --memory, from the least
# that it names on, and the voxels are the same.
awk -v n=80 'BEGIN {
  for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) {
    a = 6.283185307179586 * i / n; b = 6.283185307179586 * j / n; r = 3 + cos(b)
    printf "v %.5f %.5f %.5f\n", r * cos(a), r * sin(a), sin(b)
  }
  for (i = 0; i < n; ++i) for (j = 0; j < n; ++j)
    print "f", i * n + j + 1, (i + 1) % n * n + j + 1, (i + 1) % n * n + (j + 1) % n + 1, i * n + (j + 1) % n + 1
}' > torus.obj
bpvox torus.obj --resolution 300 -q -o torus.bpv
echo '{"base": "5%", "orientation": "auto"}' > even.json
echo '{"base": "6%", "rules": [{"box": [[-5, -5, -5], [0, 0, 5]], "scale": "3%"}], "orientation": "auto"}' > varying.json
for field in even varying; do
  bpscale $field.json torus.bpv -q -o turned.bpv --overwrite
  [ "$(bpinfo turned.bpv | sed -n 's/^orientation \([0-9]*\) rotations.*/\1/p')" -gt 200 ] && echo "$field: hundreds of rotations"
  bpclose turned.bpv -q -o want.bpv --overwrite
  bpclose turned.bpv -j 1 --memory 64M -q -o got.bpv --overwrite 2> said
  echo "= $?"
  for limit in "$(grep -o 'to at least [0-9]*' said | grep -o '[0-9]*')" 128 400; do
    bpclose turned.bpv -j 1 --memory "${limit}M" -q -o got.bpv --overwrite --report r.json
    peak=$(grep -o '"peak_memory_bytes": [0-9]*' r.json | grep -o '[0-9]*$')
    [ "$peak" -le $((limit << 20)) ] && echo "within --memory" || echo "$peak bytes of ${limit}M"
    [ "$(bpinfo got.bpv | checksum)" = "$(bpinfo want.bpv | checksum)" ] && echo "the same voxels"
    rm r.json
  done
done
