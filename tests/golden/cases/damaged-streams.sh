# A stream that was cut or changed anywhere is refused by every tool that reads it, and no output stays behind.
write_cube cube.obj
bpvox cube.obj --resolution 30 | bpclose --scale 2vx -o whole.bp
size=$(stat -c %s whole.bp)
refused=0 tried=0
expect_refusal() {  # FILE
  for reader in bpclose bpmesh bpinfo; do
    case $reader in
      bpclose) bpclose "$1" --scale 1vx -o out.bp ;;
      bpmesh) bpmesh "$1" -o out.glb ;;
      bpinfo) bpinfo "$1" ;;
    esac > /dev/null 2> said
    local status=$?
    tried=$((tried + 1))
    if [ $status = 3 ] && [ "$(wc -l < said)" = 1 ]; then
      refused=$((refused + 1))
    else
      echo "$reader: $1: exit $status: $(cat said)"
    fi
  done
}
for share in 0 1 5 13 40 60 77 90 99; do
  head -c $((size * share / 100)) whole.bp > cut-$share.bp
  expect_refusal cut-$share.bp
  cp whole.bp changed-$share.bp
  at=$((size * share / 100))
  byte=$(od -An -tu1 -j $at -N 1 whole.bp)
  printf "\\x$(printf %02x $((byte ^ 16)))" | dd of=changed-$share.bp bs=1 seek=$at conv=notrunc 2> /dev/null
  expect_refusal changed-$share.bp
done
{ cat whole.bp; echo more; } > longer.bp
expect_refusal longer.bp
[ $refused = $tried ] && echo "all refused"
rm -f cut-*.bp changed-*.bp longer.bp said
files
try bpinfo cube.obj --dump
stdin=cube.obj try bpmesh -o out.glb
stdin=cube.obj try bpclose --scale 1
stdin=cube.obj try bpinfo
files
