# Completion completes options, their words, and the names of files, in each shell that is here.
# bash: what the function of the tool answers to the words of a line; the last one is being typed.
cat > complete.bash << 'BASH'
eval "$("$1" --help bash)"
shift
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_$1 2> /dev/null
printf '%s\n' "${COMPREPLY[@]}" | LC_ALL=C sort | tr '\n' ' '
echo
BASH
mkdir folder
touch scene.obj
asked() {
  echo "\$ $* <TAB>"
  bash complete.bash "$1" "$@"
}
asked bpmesh --mo
asked bpmesh --mode ''
asked bpmesh --mode in
asked bpmesh --mode = fi
asked bpvox --fill w
asked bpvox sc
asked bpvox --fill none --vo
asked bpvox --voxel ''
asked bpclose --temp ''
asked bpclose --scale 2 --element ''
asked bpinfo --image sc
asked bpmesh --enclose cl
asked bpmesh --progress ''
asked bpmesh --progress j
asked bplod --prof
# The others parse; fish answers, too.
for tool in bpvox bpscale bpclose bpmesh bpcheck bpinfo bplod; do
  for shell in bash zsh fish; do
    $tool --help $shell > script
    command -v $shell > /dev/null && ! $shell -n script && echo "$tool: $shell cannot read its script"
  done
  $tool --help zsh > script
  ! command -v zsh > /dev/null || zsh -fc 'autoload -Uz compinit; compinit -u -d dump; functions[_tool]=$(< script); whence -w _tool' > said 2>&1 ||
    { echo "$tool: zsh:"; cat said; }
done
if command -v fish > /dev/null; then
  export HOME=$PWD XDG_CONFIG_HOME=$PWD/none XDG_DATA_HOME=$PWD/none
  fished() { fish -c "$1 --help fish | source; complete -C'$2'" 2> said | cut -f 1 | LC_ALL=C sort | tr '\n' ' '; }
  [ "$(fished bpmesh 'bpmesh --mo')" = '--mode ' ] || echo "fish: --mo: $(fished bpmesh 'bpmesh --mo')"
  [ "$(fished bpmesh 'bpmesh --mode ')" = 'bounding fit inside ' ] || echo "fish: --mode: $(fished bpmesh 'bpmesh --mode ')"
fi
