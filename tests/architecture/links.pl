#!/usr/bin/env perl
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
#
# Checks that the links of the pages in Markdown lead to files and headings that are there.
#   links.pl SOURCE_TREE
use strict;
use warnings;

chdir($ARGV[0] // die "source tree\n") or die "no source tree: $!\n";
my @pages = split /\n/, `git ls-files --cached --others --exclude-standard '*.md' 2>/dev/null || true`;
@pages = split /\n/, `find . -name '*.md' -not -path './build/*' -not -path '*/node_modules/*'` unless @pages;
die "no pages\n" unless @pages;

sub text_of {
    my ($page) = @_;
    open(my $stream, '<', $page) or die "$page: $!\n";
    local $/;
    my $text = <$stream>;
    $text =~ s/^```.*?^```//msg;
    return $text;
}

# The anchors that a page offers, as GitHub makes them of its headings.
my %anchors;
sub anchors_of {
    my ($page) = @_;
    return $anchors{$page} //= { map { my $h = lc $_; $h =~ s/[^a-z0-9 _-]//g; $h =~ s/ /-/g; $h => 1 }
                                 text_of($page) =~ /^#+ +(.*?)\s*$/mg };
}

my $broken = 0;
my $links  = 0;
for my $page (sort @pages) {
    next unless -f $page;
    (my $folder = $page) =~ s{[^/]*$}{};
    my $text = text_of($page);
    while ($text =~ /\]\(([^)\s]+)\)/g) {
        my $target = $1;
        next if $target =~ /^[a-z]+:/;
        ++$links;
        my ($path, $anchor) = $target =~ /^([^#]*)(?:#(.*))?$/;
        my $file = $path eq '' ? $page : $folder . $path;
        1 while $file =~ s{[^/]+/\.\./}{};
        if (!-e $file) { print "$page: no file $target\n"; ++$broken; }
        elsif (defined $anchor && $file =~ /\.md$/ && !anchors_of($file)->{$anchor}) {
            print "$page: no heading $target\n";
            ++$broken;
        }
    }
}
print "$links links, $broken broken\n";
exit($broken || !$links ? 1 : 0);
