// The text of `wikibooks` has no slip (docs/sources.md).
