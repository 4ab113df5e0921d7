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

_morsel() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}
  COMPREPLY=()
  shopt -q extglob || { shopt -s extglob; trap 'shopt -u extglob; trap - RETURN' RETURN; }

  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W 'segment --help --version' -- "$cur")
    return
  fi
  [[ ${COMP_WORDS[1]} == segment ]] || return

  # "--option=value" arrives as three words.
  if [[ $cur == '=' ]]; then
    cur=''
  elif [[ $prev == '=' ]]; then
    prev=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  case $prev in
    --method) mapfile -t COMPREPLY < <(compgen -W 'default paper' -- "$cur") ;;
    --denoise) mapfile -t COMPREPLY < <(compgen -W 'auto off 1 2 3' -- "$cur") ;;
    --labels) _morsel_files ;;
    -o | --output) _morsel_files 'ply|pcd|xyz|npz' ;;
    --report) _morsel_files json ;;
    --picture) _morsel_files 'png|svg' ;;
    --html) _morsel_files 'html|htm' ;;
    --sample | --noise | --seed | --parts | --merge-ratio | --big-ball-ratio | --deep-angle | \
      --threads) ;;
    *)
      if [[ $cur == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W '--labels --output --report --picture --html --parts
          --merge-ratio --method --big-ball-ratio --deep-angle --denoise --threads --sample --noise
          --seed --help' -- "$cur")
      else
        _morsel_files 'ply|pcd|xyz|txt|pts|csv|off|obj|npy|las|stl|gltf|glb'
      fi
      ;;
  esac
}

complete -F _morsel morsel
