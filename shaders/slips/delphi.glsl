// The text of `delphi` has no slip (docs/sources.md).
