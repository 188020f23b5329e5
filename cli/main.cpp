// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"
#include "to_stderr.hpp"

int main(int argc, char** argv) {
    octavo::cli::hold_standard_files();
    return octavo::cli::Program().main(argc, argv);
}
