# Completion of argand(1) for bash.  The options come from `argand help COMMAND`.
_argand() {
    local word=$2 before=$3 command=${COMP_WORDS[1]}
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W 'render info devices demo help --version' -- "$word"))
        return
    fi
    case $before in
    --tonemap) COMPREPLY=($(compgen -W 'none reinhard aces aces-narkowicz neutral agx' -- "$word")) ;;
    --quality) COMPREPLY=($(compgen -W 'fast default best' -- "$word")) ;;
    --background) COMPREPLY=($(compgen -W 'env transparent' -- "$word")) ;;
    --env) COMPREPLY=($(compgen -W 'studio sky none' -- "$word") $(compgen -f -- "$word")) ;;
    --device) COMPREPLY=($(compgen -W 'auto cpu' -- "$word")) ;;
    help) COMPREPLY=($(compgen -W 'render info devices demo' -- "$word")) ;;
    *)
        if [[ $word == -* ]]; then
            COMPREPLY=($(compgen -W "$(argand help "$command" 2>/dev/null |
                grep -o -e '^  --[a-z0-9-]*' -e '^  -[a-z], --[a-z-]*' | sed 's/.*--/--/')" -- "$word"))
        else
            COMPREPLY=($(compgen -f -- "$word"))
        fi
        ;;
    esac
}
complete -o filenames -F _argand argand
