# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes of what fastddsgen 4 put into FOLDER for NAMES (separated by commas) what the rest of Quoin knows from version 2:
# NAME.h to include, with enumerators in the scope of the module, and with serialisation as members of each structure, which
# NAME_code.cxx defines.
#   cmake -D FOLDER=... -D NAMES=... -P fastddsgen_4.cmake
string(REPLACE "," ";" names "${NAMES}")
foreach(name IN LISTS names)
  file(READ ${FOLDER}/${name}CdrAux.hpp functions)
  string(REGEX MATCHALL "const [A-Za-z0-9_:]+& data" structures "${functions}")
  file(READ ${FOLDER}/${name}.hpp types)
  string(REPLACE "enum class " "enum " types "${types}")
  string(REPLACE "#include <fastcdr/cdr/fixed_size_string.hpp>"
                 "#include <fastcdr/cdr/fixed_size_string.hpp>\nnamespace eprosima::fastcdr { class Cdr; }" types "${types}")

  set(source "#include \"${name}.h\"\n#include \"${name}CdrAux.ipp\"\n")
  foreach(structure IN LISTS structures)
    string(REGEX REPLACE "const ([A-Za-z0-9_:]+)& data" "\\1" type "${structure}")
    string(REPLACE "::" "_" flat "${type}")
    string(REGEX REPLACE ".*::" "" class "${type}")
    set(begin "class ${class}\n{\npublic:\n")
    string(FIND "${types}" "${begin}" found)
    if(found EQUAL -1 OR NOT functions MATCHES "${flat}_max_key_cdr_typesize {([0-9]+)UL}")
      message(FATAL_ERROR "fastddsgen_4.cmake: ${name}.hpp and ${name}CdrAux.hpp are not as expected for ${type}")
    endif()
    set(key ${CMAKE_MATCH_1})
    set(keyed true)
    if(key EQUAL 0)
      set(keyed false)
    endif()
    string(REPLACE "${begin}" "${begin}
    static bool isKeyDefined() { return ${keyed}; }
    static size_t getKeyMaxCdrSerializedSize() { return ${key}; }
    static size_t getCdrSerializedSize(const ${class}& data);
    void serialize(eprosima::fastcdr::Cdr& cdr) const;
    void serializeKey(eprosima::fastcdr::Cdr& cdr) const;
    void deserialize(eprosima::fastcdr::Cdr& cdr);
" types "${types}")
    set(source "${source}
size_t ${type}::getCdrSerializedSize(const ${class}& data) {
  eprosima::fastcdr::CdrSizeCalculator calculator(eprosima::fastcdr::CdrVersion::XCDRv1);
  size_t alignment = 0;
  return calculator.calculate_serialized_size(data, alignment);
}
void ${type}::serialize(eprosima::fastcdr::Cdr& cdr) const { cdr << *this; }
void ${type}::serializeKey(eprosima::fastcdr::Cdr& cdr) const { eprosima::fastcdr::serialize_key(cdr, *this); }
void ${type}::deserialize(eprosima::fastcdr::Cdr& cdr) { cdr >> *this; }
")
  endforeach()
  file(WRITE ${FOLDER}/${name}.hpp "${types}")
  file(WRITE ${FOLDER}/${name}.h "#include \"${name}.hpp\"\n")
  file(WRITE ${FOLDER}/${name}_code.cxx "${source}")
endforeach()
