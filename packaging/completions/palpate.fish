# fish: palpate says itself which words may come next, so this needs no change when a command does.
complete -c palpate -a '(set -l words (commandline -opc) (commandline -ct); palpate --complete $words[2..-1] 2>/dev/null)'
