// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/governance.hpp"

namespace quoin {

std::string governance_text(bool encrypt) {
  const std::string kind = encrypt ? "ENCRYPT" : "SIGN";
  // Content is encrypted (or signed) and each submessage signed with keys that only the readers and
  // writers of the topic get. Whole messages are not signed on top of that: Fast DDS 2.9 then fills
  // them until there is no room for the signature, and ends the process when many are sent again.
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>232</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>)" +
         kind + R"(</discovery_protection_kind>
      <liveliness_protection_kind>)" +
         kind + R"(</liveliness_protection_kind>
      <rtps_protection_kind>NONE</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>SIGN</metadata_protection_kind>
          <data_protection_kind>)" +
         kind + R"(</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)";
}

}  // namespace quoin
