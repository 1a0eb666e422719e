# The nightly sample on several machines at a time: the same files as by one, tilesets in parts. A stand-in for GNU parallel
# does what the sample asks of it: arguments that end in NUL, N of them to a job, put quoted into a command line for a shell.
mkdir bin scenes "o ut"
cat > bin/parallel << 'PARALLEL'
#!/usr/bin/env bash
n=1
while [[ $1 == -* ]]; do
  case $1 in
    -0) shift ;;
    -n) n=$2 && shift 2 ;;
    -j) jobs=$2 && shift 2 ;;
    --sshlogin | --env) shift 2 ;;
    *) echo "parallel: $1" >&2 && exit 255 ;;
  esac
done
while values=() && for ((i = 0; i < n; ++i)); do IFS= read -r -d '' value && values+=("$value") || exit 0; done; do
  printf -v line '%s ' "$@"
  for ((i = 0; i < n; ++i)); do line=${line//"{$((i + 1))}"/"$(printf %q "${values[i]}")"}; done
  line=${line//"{}"/"$(printf %q "${values[0]}")"}
  printf '%s\0' "$line"
done | xargs -0 -P "$jobs" -I{} bash -c 'printf "%s\n" "$1" >> "$CALLS"; eval "$1"' parallel {}
PARALLEL
chmod +x bin/parallel
export CALLS=$PWD/calls
for i in 0 2; do
  write_cube cube.obj 3
  sed "s/^v \(.*\) \(.*\) \(.*\)$/echo v \$((\1 + 7 * $i)) \2 \$((\3 + $i))/e" cube.obj > "scenes/part $i.obj"
done
echo "v 1 2" > scenes/broken.obj
table() { sed 's/made in [0-9]* s/made/' | cut -f 1-3; }
exec 2> as-it-goes  # in no order
options=(--voxel 0.022 --tile 128 --levels 2 --profile 3dtiles --name "it's")
"$BP_ROOT/samples/nightly" "$PWD/scenes" serial "${options[@]}" | table > table
PATH=$PWD/bin:$PATH PARTS=3 "$BP_ROOT/samples/nightly-parallel" scenes "o ut" "${options[@]}" | table
diff table <(table < "o ut/report.tsv") && echo "the same table"
diff -r -x .cache -x report.tsv -x '.*.log' serial "o ut" && echo "the same files"
# What was run; and nothing is made twice.
sed "s|$BP_ROOT||; s|'$PWD/o ut'.*||; s|$PWD/||" calls | LC_ALL=C sort
rm calls
PATH=$PWD/bin:$PATH "$BP_ROOT/samples/nightly-parallel" scenes "o ut" "${options[@]}" | table
grep -c -e --part calls
write_cube "scenes/part 2.obj" 4
PATH=$PWD/bin:$PATH "$BP_ROOT/samples/nightly-parallel" scenes "o ut" "${options[@]}" | table
PATH=$PWD/bin:$PATH "$BP_ROOT/samples/nightly-parallel" scenes plain --faces 60,20 --resolution 24 | table
LC_ALL=C ls -A "o ut" "plain/part 0.obj"
PATH=$PWD/bin:$PATH try "$BP_ROOT/samples/nightly-parallel" nowhere out | sed "s|$BP_ROOT/||"
