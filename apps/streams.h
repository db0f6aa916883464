#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/shown_text.h"

namespace ursula {

/// For people, on standard error. That nobody can read it is no reason to stop: only lost data is. What a terminal
/// would obey is sent as it stands.
void sayText(const std::string& text);

/// A sentence. Names of files and what is in them come from anybody: a terminal is told nothing to obey.
template <class... Arguments>
void say(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
  sayText(withoutControls(fmt::format(form, std::forward<Arguments>(arguments)...)));
}

/// Before anything is opened: what was closed by the caller gets a place, so that no file takes it and gets the words
/// that are meant for a terminal. Writing to standard output then fails as it would have. A reader that goes away, or a
/// file that may not be so large, is an error of the write, not the end of the program.
void secureStreams();

/// The C library loads what unwinds threads when it first needs it, and ends the program where memory is short then.
void loadUnwinder();

/// Where the address space is bounded (`ulimit -v`), threads allocate from one arena: glibc reserves 64 MB for each of
/// others, and where it cannot, tries again at every call.
void shareArenaInBoundedMemory();

/// Why what was printed to standard output is not there; "" where all of it is.
std::string lostOutput();

}  // namespace ursula
