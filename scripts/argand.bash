# Completion of argand(1) for bash.  The options come from `argand help COMMAND`.
_argand_options() {
    argand help "$1" 2>/dev/null | sed -n 's/^  \(-[a-z], \)\{0,1\}\(--[a-z0-9-]*\).*/\2/p'
}

_argand() {
    local word=$2 before=$3 words= files=
    case $before in
    argand | */argand)
        words='view render reference compare validate convert info devices demo help --version'
        ;;
    --tonemap) words='none reinhard aces aces-narkowicz neutral agx' ;;
    --exposure) words='auto' ;;
    --metering) words='average center spot' ;;
    --transfer) words='srgb gamma2.2' ;;
    --area-lights) words='exact ltc representative-point' ;;
    --aov) words='albedo normal depth direct indirect' ;;
    --parts) words='seen lights diffuse specular emitted' ;;
    --estimator) words='both lights surface' ;;
    --quality) words='fast default best' ;;
    --background) words='env transparent' ;;
    --env) words='studio sky none' files=1 ;;
    --device) words='auto cpu' ;;
    help) words='view render reference compare validate convert info devices demo' ;;
    *)
        if [[ $word == -* ]]; then
            words=$(_argand_options "${COMP_WORDS[1]}")
        else
            files=1
        fi
        ;;
    esac
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    [ -z "$files" ] || COMPREPLY+=($(compgen -f -- "$word"))
}
complete -o filenames -F _argand argand
