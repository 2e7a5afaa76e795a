# fish completion for motus(1)
function __motus_methods
    motus methods --json 2>/dev/null | string match -ra '"name": *"[^"]*"' | string replace -r '.*"([^"]*)"$' '$1'
end
set -l verbs run compare converge sweep check methods lab cache
complete -c motus -f
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -a run -d 'the motion'
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -a cache -d 'compiled models'
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -a compare -d 'every method side by side'
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -a converge -d 'observed order and its certificate'
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -a sweep -d 'many trajectories'
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -a check -d 'equations and admitted methods'
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -a methods -d 'the catalogue of methods'
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -a lab -d 'the page, in the browser'
complete -c motus -n "not __fish_seen_subcommand_from $verbs" -l version -d 'the version'
complete -c motus -n "__fish_seen_subcommand_from run compare converge sweep check lab" -k -a "(__fish_complete_suffix .motus)"
complete -c motus -n "__fish_seen_subcommand_from methods" -a "(__motus_methods)"
complete -c motus -n "__fish_seen_subcommand_from converge" -l points -d 'the error at every step'
complete -c motus -n "__fish_seen_subcommand_from methods" -l markdown -d 'as a Markdown table'
complete -c motus -n "__fish_seen_subcommand_from run sweep lab" -l method -x -a "(__motus_methods)" -d 'the method'
complete -c motus -n "__fish_seen_subcommand_from compare converge lab" -l methods -x -a "(__fish_append , (__motus_methods))" -d 'these methods'
complete -c motus -n "__fish_seen_subcommand_from run compare converge sweep lab" -l step -x -d 'time step'
complete -c motus -n "__fish_seen_subcommand_from run" -l accuracy -x -d 'error of the answer'
complete -c motus -n "__fish_seen_subcommand_from run sweep" -l tolerance -x -d 'of an adaptive method: error of a step'
complete -c motus -n "__fish_seen_subcommand_from run sweep" -l shortest-step -x -d 'of an adaptive method'
complete -c motus -n "__fish_seen_subcommand_from run sweep" -l longest-step -x -d 'of an adaptive method'
complete -c motus -n "__fish_seen_subcommand_from run sweep" -l most-steps -x -d 'of an adaptive method'
complete -c motus -n "__fish_seen_subcommand_from run compare converge sweep lab" -l until -x -d 'end'
complete -c motus -n "__fish_seen_subcommand_from run compare converge sweep check lab" -l set -x -d 'replace a parameter or initial value'
complete -c motus -n "__fish_seen_subcommand_from compare" -l evaluations -x -d 'equal work'
complete -c motus -n "__fish_seen_subcommand_from compare" -l accuracies -x -d 'work for accuracies from A to B'
complete -c motus -n "__fish_seen_subcommand_from run sweep lab" -s o -l output -r -F -d 'trajectory as CSV, or the page'
complete -c motus -n "__fish_seen_subcommand_from run" -l error -x -a 'cheap full none' -d 'the error of the answer'
complete -c motus -n "__fish_seen_subcommand_from run" -l errors -d 'errors as columns of the CSV'
complete -c motus -n "__fish_seen_subcommand_from run" -l columns -x -d 'columns of the CSV'
complete -c motus -n "__fish_seen_subcommand_from run sweep" -l every -x -d 'a row every time, or "n steps"'
complete -c motus -n "__fish_seen_subcommand_from run compare converge" -l plot -r -F -d 'draw with gnuplot'
complete -c motus -n "__fish_seen_subcommand_from run" -l plot-of -x -d 'column against column'
complete -c motus -n "__fish_seen_subcommand_from run" -l save-state -r -F -d 'write an exact restart state'
complete -c motus -n "__fish_seen_subcommand_from run" -l restart -r -F -d 'continue from one'
complete -c motus -n "__fish_seen_subcommand_from run sweep" -l machine -x -a 'auto interpreter compiled' -d machine
complete -c motus -n "__fish_seen_subcommand_from run" -l emit-c -d 'print the C text that runs'
complete -c motus -n "__fish_seen_subcommand_from sweep" -l vary -x -d 'values of a parameter'
complete -c motus -n "__fish_seen_subcommand_from sweep" -l random -x -d 'what is drawn'
complete -c motus -n "__fish_seen_subcommand_from sweep" -l count -x -d draws
complete -c motus -n "__fish_seen_subcommand_from sweep" -l seed -x -d 'of the draws'
complete -c motus -n "__fish_seen_subcommand_from sweep" -l zip -d 'pair the values'
complete -c motus -n "__fish_seen_subcommand_from sweep" -l record -x -d 'what is recorded'
complete -c motus -n "__fish_seen_subcommand_from sweep" -l resume -d 'continue the file'
complete -c motus -n "__fish_seen_subcommand_from sweep" -l force -d 'replace the file'
complete -c motus -n "__fish_seen_subcommand_from run sweep" -l threads -x -d threads
complete -c motus -n "__fish_seen_subcommand_from sweep" -l lanes -x -d 'trajectories in a vector'
complete -c motus -n "__fish_seen_subcommand_from sweep" -l fast -d 'let the compiler reorder'
complete -c motus -n "__fish_seen_subcommand_from run compare" -l share -d 'print the fragment of a link'
complete -c motus -n "__fish_seen_subcommand_from lab" -l no-open -d 'start no browser'
complete -c motus -n "__fish_seen_subcommand_from cache" -l clear -d 'remove compiled models'
complete -c motus -n "__fish_seen_subcommand_from $verbs" -l json -d 'one JSON object'
complete -c motus -n "__fish_seen_subcommand_from $verbs" -s q -l quiet -d 'nothing but errors'
complete -c motus -n "__fish_seen_subcommand_from $verbs" -s h -l help -d help
