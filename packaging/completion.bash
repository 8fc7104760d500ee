# Bash completion of Septet's programs. It asks them: commands and options are those of their --help, names those of `septet list`.
_septet() {
  local program=$1 word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} folder='' septet=septet
  # The list's `septet` is the one beside the program.
  case $program in */*) folder=${program%/*}/ ;; esac
  septet=${folder}septet
  COMPREPLY=()
  case $before in
    --rig) mapfile -t COMPREPLY < <(_septet_names "$septet" rigs) ;;
    --scenario) mapfile -t COMPREPLY < <(_septet_names "$septet" scenarios) ;;
    --vehicle) mapfile -t COMPREPLY < <(_septet_names "$septet" vehicles) ;;
    --driver) mapfile -t COMPREPLY < <(_septet_names "$septet" drivers) ;;
    *)
      # The command so far: the words that a --help lists below "Subcommands:".
      local commands=() next help
      help=$("$program" --help 2>/dev/null)
      for next in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        _septet_subcommands "$help" | grep -qxF -- "$next" || continue
        commands+=("$next")
        help=$("$program" "${commands[@]}" --help 2>/dev/null)
      done
      if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(grep -oE '^  (-h,)?--[a-z-]+' <<<"$help" | grep -oE -- '--[a-z-]+')
      else
        mapfile -t COMPREPLY < <(_septet_subcommands "$help"; grep -oE '^  [a-z]+ TEXT:\{[^}]+\}' <<<"$help" | sed -E 's/.*\{(.*)\}/\1/' | tr , '\n')
      fi
      ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "${COMPREPLY[*]}" -- "$word")
}

_septet_subcommands() { sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p' <<<"$1"; }
_septet_names() { "$1" list "$2" 2>/dev/null | awk '{print $1}'; }

# Where nothing fits, files do.
complete -o default -F _septet septet septet-server septet-screen septet-film septet-sound septet-sight septet-ice septet-car
