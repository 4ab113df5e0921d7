# bash completion for morsel; installed as …/bash-completion/completions/morsel, or sourced.

_morsel_files() {
  # Names that end in one of the extensions, and folders; every file where there are none.
  compopt -o filenames 2>/dev/null
  if [[ -z ${1-} ]]; then
    mapfile -t COMPREPLY < <(compgen -f -- "$cur")
  else
    mapfile -t COMPREPLY < <(compgen -d -- "$cur"; compgen -f -X "!*.@($1)" -- "$cur")
  fi
}

_morsel_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }

_morsel() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  local shapes='ply|pcd|xyz|txt|pts|csv|off|obj|npy|las|stl|gltf|glb'
  local mesh='--sample --noise --seed --threads --help'
  local segmenting='--method --big-ball-ratio --deep-angle --denoise --ground'
  local score='--method --mode --no-mirror'
  local options=''
  COMPREPLY=()
  shopt -q extglob || { shopt -s extglob; trap 'shopt -u extglob; trap - RETURN' RETURN; }

  if ((COMP_CWORD == 1)); then
    _morsel_words 'segment index search compare matrix serve list show remove rename export import
      check --help --version'
    return
  fi
  case $command in
    segment)
      options="--labels --output --report --picture --html --parts --merge-ratio $segmenting $mesh" ;;
    index) options="--database --class --tag --shard --status $segmenting $mesh" ;;
    search) options="--database --top --json --picture --same-scale $score $mesh" ;;
    compare) options="--database --json --picture --same-scale $score $mesh" ;;
    matrix) options="--database --output --picture $score --threads --help" ;;
    serve) options='--database --host --port --token --most-upload --threads --help' ;;
    list) options='--database --class --tag --json --help' ;;
    show) options='--database --json --picture --thumbnail --help' ;;
    export) options='--database --output --help' ;;
    check) options='--database --repair --help' ;;
    remove | rename | import) options='--database --help' ;;
    *) return ;;
  esac

  # "--option=value" arrives as three words.
  if [[ $cur == '=' ]]; then
    cur=''
  elif [[ $prev == '=' ]]; then
    prev=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  case $prev in
    --method) _morsel_words 'default paper' ;;
    --mode) _morsel_words 'rigid articulated partial' ;;
    --denoise) _morsel_words 'auto off 1 2 3' ;;
    --ground) _morsel_words 'auto keep remove' ;;
    --labels) _morsel_files ;;
    --database) _morsel_files db ;;
    -o | --output)
      case $command in
        segment) _morsel_files 'ply|pcd|xyz|npz' ;;
        matrix) _morsel_files csv ;;
        *) _morsel_files ;;
      esac
      ;;
    --report) _morsel_files json ;;
    --picture) _morsel_files 'png|svg' ;;
    --html) _morsel_files 'html|htm' ;;
    --thumbnail) _morsel_files png ;;
    --class)
      if [[ $command == index ]]; then
        _morsel_files csv
        [[ folder == "$cur"* ]] && COMPREPLY+=(folder)
      fi
      ;;
    --sample | --noise | --seed | --parts | --merge-ratio | --big-ball-ratio | --deep-angle | \
      --threads | --top | --tag | --host | --port | --token | --most-upload) ;;
    *)
      if [[ $cur == -* ]]; then
        _morsel_words "$options"
      else
        case $command in
          segment | index | search | compare) _morsel_files "$shapes" ;;
          import) _morsel_files ;;
        esac
      fi
      ;;
  esac
}

complete -F _morsel morsel
