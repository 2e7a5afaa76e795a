# bash completion for motus(1). Verbs and options are those that `motus --options` tells.
_motus() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} verb= wants words= table word
    table=$(motus --options 2>/dev/null)
    cells() { awk -F'\t' -v verb="$verb" -v option="$previous" "$1" <<<"$table"; }
    methods() { motus methods --json 2>/dev/null | grep -o '"name": *"[^"]*"' | cut -d'"' -f4; }
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        [[ -z $verb && $'\n'$table == *$'\n'verb$'\t'$word$'\t'* ]] && verb=$word
    done
    COMPREPLY=()
    if [[ -z $verb ]]; then
        wants=- words="$(cells '$1 == "verb" { print $2 }') --help --version"
    else
        wants=$(cells '$1 == "option" && ($2 == option || $3 == option) && index("," $5 ",", "," verb ",") && $4 != "-" { print $4 }')
        words=$(cells '$1 == "option" && ($2 == option || $3 == option) && index("," $5 ",", "," verb ",") && $7 != "-" { print $7 }')
        [[ -z $wants && $current == -* ]] &&
            wants=- words=$(cells '$1 == "option" && index("," $5 ",", "," verb ",") { print $2 }')
        : "${wants:=$(cells '$1 == "verb" && $2 == verb { print $3 }')}"
    fi
    case $wants in
    M|M,...|*METHOD*) mapfile -t COMPREPLY < <(compgen -P "$([[ $current == *,* ]] && echo "${current%,*},")" -W "$(methods)" -- "${current##*,}") ;;
    FILE*|FIG) compopt -o default ;;
    *MODEL*)
        compopt -o filenames
        mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -X '!*.motus' -- "$current") ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current") ;;
    esac
}
complete -F _motus motus
