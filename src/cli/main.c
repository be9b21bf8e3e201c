// argand(1): finds the command and runs it.
#include "commands.h"

#include <argand/argand.h>

#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

static exit_code dispatch(int argc, char **argv)
{
    if (argc < 2) {
        help_short();
        return EXIT_USAGE;
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("argand %s\n", ag_version());
        return EXIT_DONE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)
        return command_help.run(0, NULL);
    const command *c = command_find(argv[1]);
    return c ? c->run(argc - 2, argv + 2) : command_unknown(argv[1]);
}

// Large blocks go back to the system when they are freed.  By itself glibc raises its
// threshold with every image that is freed, and keeps the next ones.
static void return_large_blocks(void)
{
#ifdef M_MMAP_THRESHOLD
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

int main(int argc, char **argv)
{
    return_large_blocks();
    signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error to report, not a signal
    exit_code code = dispatch(argc, argv);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        perror("argand: standard output cannot be written");
        return EXIT_FAILED;
    }
    return (int)code;
}
