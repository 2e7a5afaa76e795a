# bash completion for motus(1)
_motus() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} verb= i
    for ((i = 1; i < COMP_CWORD; i++)); do
        case ${COMP_WORDS[i]} in run|compare|converge|sweep|merge|archive|check|methods|lab|cache) verb=${COMP_WORDS[i]}; break ;; esac
    done
    COMPREPLY=()
    if [[ -z $verb ]]; then
        mapfile -t COMPREPLY < <(compgen -W 'run compare converge sweep merge archive check methods lab cache --help --version' -- "$current")
        return
    fi
    local methods='motus methods --json 2>/dev/null | grep -o "\"name\": *\"[^\"]*\"" | cut -d\" -f4'
    case $previous in
    --method|--methods)
        mapfile -t COMPREPLY < <(compgen -P "$([[ $current == *,* ]] && echo "${current%,*},")" -W "$(eval "$methods")" -- "${current##*,}")
        return ;;
    --machine) mapfile -t COMPREPLY < <(compgen -W 'auto interpreter compiled' -- "$current"); return ;;
    --error) mapfile -t COMPREPLY < <(compgen -W 'cheap full none' -- "$current"); return ;;
    --verify) mapfile -t COMPREPLY < <(compgen -W '1% all' -- "$current"); return ;;
    --switches) mapfile -t COMPREPLY < <(compgen -W 'locate step' -- "$current"); return ;;
    -o|--output|--events|--plot|--save-state|--restart) compopt -o default; return ;;
    --step|--accuracy|--tolerance|--shortest-step|--longest-step|--most-steps|--until|--set|--when|--section|--skip|--evaluations|--accuracies|--columns|--every|--plot-of|--vary|--random|--count|--seed|--threads|--lanes|--record|--shard|--checkpoint) return ;;
    esac
    if [[ $current == -* ]]; then
        local options='--json --quiet --help'
        case $verb in
        run)      options+=' --method --accuracy --tolerance --shortest-step --longest-step --most-steps --step --until --set --output --events --when --section --skip --points --columns --every --plot --plot-of --save-state --restart --machine --threads --emit-c --share --error --errors --switches --checkpoint --resume --force --compress' ;;
        compare)  options+=' --methods --step --until --set --evaluations --accuracies --machine --plot --share' ;;
        converge) options+=' --methods --step --until --set --plot --points' ;;
        sweep)    options+=' --vary --random --count --seed --zip --record --method --tolerance --shortest-step --longest-step --most-steps --switches --step --until --every --set --when --output --plan --resume --force --compress'
                  options+=' --threads --lanes --machine --fast --accuracy --error --errors --events --section --skip --points --plot --plot-of --shard' ;;
        merge)    options+=' --output --partial --force --compress' ;;
        archive)  options+=' --output --force --verify --threads --machine' ;;
        lab)      options+=' --method --methods --step --until --set --output --no-open' ;;
        cache)    options+=' --clear' ;;
        check)    options+=' --set --when' ;;
        methods)  options+=' --markdown' ;;
        esac
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
    elif [[ $verb == methods ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(eval "$methods")" -- "$current")
    elif [[ $verb == merge || $verb == archive ]]; then
        compopt -o default
    else
        compopt -o filenames
        mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -X '!*.motus' -- "$current")
    fi
}
complete -F _motus motus
