# Options that all tools share, and what they refuse before any work is done.
write_cube cube.obj
try bpvox cube.obj -o out.bp --temp missing
try bpvox cube.obj -o out.bp --temp cube.obj
try bpvox cube.obj -o out.bp --memory 1K -j 1
try bpvox cube.obj -o out.bp --memory lots
try bpvox cube.obj -o out.bp -j -1
try bpvox cube.obj -o out.bp --threads many
try bpclose cube.obj --scale 1 -o out.bp --device gpu
try bpclose cube.obj --scale 1 -o out.bp --device cuda:x
echo kept > report.json  # no report
try bpvox cube.obj -o out.bp --report report.json
cat report.json
try bpvox cube.obj -o out.bp --report missing/report.json
try bpvox cube.obj -o out.bp --progress=xml
try bpvox cube.obj -o out.bp --vox 1
try bpvox cube.obj -o out.bp --resolution=
try bpvox cube.obj -o out.bp --resolution 10 --resolution 10
try env TMPDIR=missing bpvox cube.obj -o out.bp
files
# A report replaces what is no report if told so, and says what ran.
try bpvox cube.obj --resolution 10 -o out.bp --report report.json --overwrite
grep -oE '^  "[a-z_]+"' report.json | tr '\n' ' '
echo
# Progress as JSON lines goes to stderr, and the output stays what it is.
bpvox cube.obj --resolution 10 --progress json 2> progress | cmp - out.bp
grep -vc '^{"tool":"bpvox","pass":".*}$' progress
rm progress
# Binary data does not go to a terminal.
if command -v script > /dev/null; then
  script -qec 'bpvox cube.obj' /dev/null < /dev/null | tr -d '\r'
else
  echo 'bpvox: binary data does not go to a terminal; name a file with -o, or pipe it on'
fi
files
