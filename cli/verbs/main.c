/* motus, the program, without a team. */
#include "cli/verbs/program.h"

int main(int argc, char **argv)
{
    program_begin();
    return program_main(argc, argv, NULL);
}
