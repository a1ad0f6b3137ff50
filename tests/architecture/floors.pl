#!/usr/bin/env perl
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Follows the includes of all sources, as far as they lead, and tells where a file reaches something
# above its floor, where folders include each other in a cycle, and how many files a main file reaches.
#   floors.pl SOURCE_TREE
use strict;
use warnings;

chdir($ARGV[0] // die "source tree\n") or die "no source tree: $!\n";

# From the ground up. A file belongs to the first line that its path begins with; it reaches its own floor and
# those below it. Floors of one number do not know each other.
my @floors = (
    [ 'core/',                           0 ],
    [ 'sensor_bridge/number.hpp',        1 ],
    [ 'sensor_bridge/excerpt.hpp',       1 ],
    [ 'sensor_bridge/mounting.hpp',      1 ],
    [ 'sensor_bridge/range_limits.hpp',  1 ],
    [ 'sensor_bridge/transport/',        1 ],
    [ 'sensor_bridge/rplidar/protocol/', 1 ],
    [ 'sensor_bridge/rplidar/driver/',   2 ],
    [ 'sensor_bridge/message_files/',    2 ],
    [ 'sensor_bridge/simulated/world_file', 2 ],
    [ 'services/topics/',                3 ],
    [ 'services/files/',                 1 ],
    [ 'services/maps/',                  3 ],
    [ 'sensor_bridge/recordings/',       4 ],
    [ 'services/deployment/',            4 ],
    [ 'services/keys/',                  5 ],
    [ 'services/runtime/dds/',           6 ],
    [ 'services/runtime/accounting/',    7 ],
    [ 'services/runtime/node/',          8 ],
    [ 'services/runtime/process/',       9 ],
    [ 'services/',                       10 ],
    # Formats, settings and bodies of the sources, and what stands beside their mains.
    [ 'sensor_bridge/rplidar/emulator/', 10 ],
    [ 'sensor_bridge/',                  11 ],
    [ 'deploy/examples/library/',        1 ],
    [ 'deploy/kinds/',                   12 ],
    [ 'deploy/evaluation/drawing/',      12 ],
    [ 'deploy/observation/',             13 ],
    [ 'deploy/diagnostics/',             14 ],
    [ 'deploy/orchestration/',           14 ],
    [ 'deploy/export/',                  14 ],
    [ 'deploy/starter/',                 14 ],
    [ 'deploy/bundle/',                  14 ],
    [ 'deploy/recordings/',              14 ],
    [ 'deploy/evaluation/',              14 ],
    [ 'deploy/calibration/',             15 ],
    [ 'deploy/command/',                 16 ],
);
# How many files the main file of a service may reach.
# Landmarks are some twenty files by themselves; recorder and ros2_output reach all types; the viewer runs all methods to explain what they did.
my %most_files = (
    'services/localization/main.cpp' => 159,
    'services/mapping/main.cpp'      => 159,
    'services/recorder/main.cpp'     => 128,
    'services/ros2_output/main.cpp'  => 127,
    'services/segmentation/main.cpp' => 146,
    'services/viewer/main.cpp'       => 200,
);
my $most_files_of_others = 120;

sub floor_of {
    my ($file) = @_;
    for my $floor (@floors) { return $floor->[1] if index($file, $floor->[0]) == 0; }
    return -1;
}

my %includes;
for my $file (split /\n/, `find core sensor_bridge services deploy -name '*.[ch]pp' -type f`) {
    open(my $stream, '<', $file) or die "$file: $!\n";
    $includes{$file} = [];
    while (my $line = <$stream>) { push @{ $includes{$file} }, $1 if $line =~ /^#include "([^"]+)"/ && -f $1; }
}

# What a file reaches: its includes, theirs, and the sources beside the headers. With the way to each.
sub reach {
    my ($start) = @_;
    my %from = ($start => undef);
    my @left = ($start);
    while (defined(my $file = shift @left)) {
        my @next = @{ $includes{$file} };
        if ($file =~ /^(.*)\.hpp$/ && exists $includes{"$1.cpp"}) { push @next, "$1.cpp"; }
        for my $next (@next) {
            next if exists $from{$next} || !exists $includes{$next};
            $from{$next} = $file;
            push @left, $next;
        }
    }
    return \%from;
}

my $violations = 0;

my %told;
for my $file (sort keys %includes) {
    my $floor = floor_of($file);
    if ($floor < 0) { print "$file is on no floor (tests/architecture/floors.pl)\n"; ++$violations; next; }
    my $from = reach($file);
    for my $reached (sort keys %$from) {
        next if floor_of($reached) <= $floor;
        my @way = ($reached);
        unshift @way, $from->{ $way[0] } while defined $from->{ $way[0] };
        # The step that goes up is the one to mend; it is told once.
        my ($step) = grep { floor_of($way[$_]) < floor_of($way[ $_ + 1 ]) } 0 .. $#way - 1;
        next if $told{"$way[$step] $way[$step + 1]"}++;
        print "upwards: ", join(' -> ', @way), "\n";
        ++$violations;
    }
}

# Folders, with a way from each back to itself.
my %folders;
for my $file (keys %includes) {
    (my $folder = $file) =~ s{/[^/]+$}{};
    for my $next (@{ $includes{$file} }) {
        (my $other = $next) =~ s{/[^/]+$}{};
        $folders{$folder}{$other} = "$file -> $next" if $other ne $folder;
    }
}
my %in_cycle;
for my $start (sort keys %folders) {
    my %from = ($start => undef);
    my @left = ($start);
    while (defined(my $folder = shift @left)) {
        for my $next (sort keys %{ $folders{$folder} // {} }) {
            if ($next eq $start) {
                my @way = ($folder);
                unshift @way, $from{ $way[0] } while defined $from{ $way[0] };
                next if $in_cycle{ join ' ', sort @way }++;
                print "cycle of folders: ", join(' -> ', @way, $start), "\n";
                print "  $folders{$way[$_]}{ $_ == $#way ? $start : $way[$_ + 1] }\n" for 0 .. $#way;
                ++$violations;
            }
            next if exists $from{$next};
            $from{$next} = $folder;
            push @left, $next;
        }
    }
}

for my $main (sort grep { m{^services/[^/]+/main\.cpp$} } keys %includes) {
    my $count = keys %{ reach($main) };
    print "$main reaches $count files\n";
    my $most = $most_files{$main} // $most_files_of_others;
    if ($count > $most) { print "  more than $most\n"; ++$violations; }
}

print $violations ? "$violations violations\n" : "all floors kept\n";
exit($violations ? 1 : 0);
