# fish completion for motus(1). Verbs and options are those that `motus --options` tells.
function __motus_methods
    motus methods --json 2>/dev/null | string match -ra '"name": *"[^"]*"' | string replace -r '.*"([^"]*)"$' '$1'
end
set -l table (motus --options 2>/dev/null)
set -l verbs (string match -r '^verb\t([^\t]*)' -g -- $table)
complete -c motus -f
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -l version -d 'the version'
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -l help -d 'help'
for line in $table
    set -l cells (string split \t -- $line)
    if test $cells[1] = verb
        complete -c motus -n "not __fish_seen_subcommand_from $verbs" -a $cells[2] -d $cells[4]
        set -l when "__fish_seen_subcommand_from $cells[2]"
        switch $cells[3]
            case '*MODEL*'
                complete -c motus -n $when -k -a "(__fish_complete_suffix .motus)"
            case '*METHOD*'
                complete -c motus -n $when -a "(__motus_methods)"
            case 'FILE*'
                complete -c motus -n $when -F
        end
    else
        set -l row -n "__fish_seen_subcommand_from "(string replace -a , ' ' -- $cells[5]) \
            -l (string sub -s 3 -- $cells[2]) -d (string replace -a '`' '' -- $cells[8])
        test $cells[3] = -; or set -a row -s (string sub -s 2 -- $cells[3])
        switch $cells[4]
            case -
            case M
                set -a row -x -a "(__motus_methods)"
            case 'M,*'
                set -a row -x -a "(__fish_append , (__motus_methods))"
            case FILE FIG
                set -a row -r -F
            case '*'
                set -a row -x
                test "$cells[7]" = -; or set -a row -a "$cells[7]"
        end
        complete -c motus $row
    end
end
