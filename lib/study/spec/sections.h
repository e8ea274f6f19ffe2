// The sections of a study that name options of programs.
#pragma once

#include <string>

#include "study/spec/keys.h"
#include "study/spec/study_file.h"

namespace phos::inline study {

/// Path of a file that the study names, from the study's own folder; it joins study.files. Throws
/// Error(bad_input) where it is not there.
std::string existing_file(StudyFile& study, const std::string& name, const std::string& where);

/// [photons], [irradiance], ..., and [common]: fills sections, fixed and factors. Throws as read_study().
void read_sections(const TomlFile& file, StudyFile& study, const CommandRunner& runner);

/// What is left in [reference]: options of phos-reference, one value each.
void read_reference_options(StudyKeys& keys, StudyFile& study, const CommandRunner& runner);

}  // namespace phos::inline study
