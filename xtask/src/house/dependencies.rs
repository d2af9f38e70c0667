//! Dependencies of each file on those that its names lead to. A parent's re-export of a child's item
//! does not count as a use.

use crate::house::folders::sources;
use crate::house::names::{Import, imports, paths};
use crate::house::source::SourceFile;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use wayside::host::failure::Failure;

/// The files of a crate and the dependencies between them.
pub(crate) struct FileDependencies {
    pub(crate) files: Vec<SourceFile>,
    /// Indices of the files that each file uses.
    pub(crate) to: Vec<BTreeSet<usize>>,
}

impl FileDependencies {
    /// Reads the files below a crate's `src` and finds their dependencies.
    pub(crate) fn of(source: &Path) -> Result<Self, Failure> {
        let files = sources(source)
            .iter()
            .map(|place| SourceFile::read(source, place))
            .collect::<Result<Vec<_>, _>>()?;
        let to = NameResolver::of(&files).dependencies();
        Ok(Self { files, to })
    }

    /// Number of dependencies.
    pub(crate) fn count(&self) -> usize {
        self.to.iter().map(BTreeSet::len).sum()
    }
}

/// Largest number of re-exports followed in a chain.
const MAX_REEXPORTS: usize = 8;

/// Files by their modules, and their imports: all that is needed to resolve names.
struct NameResolver<'a> {
    files: &'a [SourceFile],
    number_of: BTreeMap<&'a [String], usize>,
    imports: Vec<Vec<Import>>,
}

impl<'a> NameResolver<'a> {
    fn of(files: &'a [SourceFile]) -> Self {
        let number_of =
            files.iter().enumerate().map(|(number, file)| (file.module.as_slice(), number)).collect();
        let imports = files.iter().map(|file| imports(&file.text)).collect();
        Self { files, number_of, imports }
    }

    fn dependencies(&self) -> Vec<BTreeSet<usize>> {
        (0..self.files.len()).map(|from| self.dependencies_of(from)).collect()
    }

    fn dependencies_of(&self, from: usize) -> BTreeSet<usize> {
        let is_reexport = |import: &&Import| import.is_public && self.is_own(from, &import.path);
        let imported =
            self.imports[from].iter().filter(|import| !is_reexport(import)).map(|import| import.path.clone());
        let known_as = |path: Vec<String>| {
            let import = self.imports[from].iter().find(|import| import.name == path[0]);
            import.map(|import| [import.path.as_slice(), &path[1..]].concat()).unwrap_or(path)
        };
        let in_code = paths(&self.files[from].text).into_iter().map(known_as);
        let targets = imported.chain(in_code).filter_map(|path| self.resolve(from, &path, MAX_REEXPORTS));
        targets.filter(|to| *to != from).collect()
    }

    /// Whether a path begins with the file itself or a child of it.
    fn is_own(&self, file: usize, path: &[String]) -> bool {
        path[0] == "self" || self.child(file, &path[0]).is_some()
    }

    fn child(&self, file: usize, name: &str) -> Option<usize> {
        let module = [self.files[file].module.as_slice(), &[name.to_owned()]].concat();
        self.number_of.get(module.as_slice()).copied()
    }

    /// The file that defines the path's item; `None` for other crates.
    fn resolve(&self, from: usize, path: &[String], depth: usize) -> Option<usize> {
        let (mut file, mut rest) = self.path_start(from, path)?;
        while let Some(name) = rest.first() {
            if let Some(child) = self.child(file, name) {
                (file, rest) = (child, &rest[1..]);
                continue;
            }
            let import = self.imports[file].iter().find(|import| import.name == *name);
            let Some(import) = import.filter(|_| depth > 0) else { break };
            let further = [import.path.as_slice(), &rest[1..]].concat();
            return self.resolve(file, &further, depth - 1).or(Some(file));
        }
        Some(file)
    }

    /// The file at which a path begins, and the rest of the path.
    fn path_start<'p>(&self, from: usize, path: &'p [String]) -> Option<(usize, &'p [String])> {
        let module = &self.files[from].module;
        let ups = path.iter().take_while(|name| *name == "super").count();
        match path[0].as_str() {
            "crate" => Some((*self.number_of.get(&[][..])?, &path[1..])),
            "self" => Some((from, &path[1..])),
            "super" => Some((*self.number_of.get(&module[..module.len().checked_sub(ups)?])?, &path[ups..])),
            name => self.child(from, name).map(|_| (from, path)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dependencies of files, as `from to`.
    fn dependencies(files: &[(&str, &str)]) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let place = folder.path().join(name);
            std::fs::create_dir_all(place.parent().unwrap()).unwrap();
            std::fs::write(place, text).unwrap();
        }
        let found = FileDependencies::of(folder.path()).unwrap();
        let name = |i: usize| found.files[i].module.join("::");
        let of = |(from, to): (usize, &BTreeSet<usize>)| -> Vec<String> {
            to.iter().map(|to| format!("{} {}", name(from), name(*to))).collect()
        };
        found.to.iter().enumerate().flat_map(of).collect()
    }

    #[test]
    fn a_name_leads_through_doors_to_the_file_that_it_is_of() {
        let files = [
            ("lib.rs", "mod a;\nmod b;\npub use a::deep::Thing;\n"),
            ("a.rs", "pub mod deep;\npub use deep::Other;\n"),
            ("a/deep.rs", "use super::super::b;\npub struct Thing;\npub struct Other;\nfn f() { b::g() }\n"),
            (
                "b.rs",
                "use crate::Thing;\nuse crate::a::Other as Same;\npub fn g() {}\n#[cfg(test)]\nmod tests {\n    use super::*;\n}\n",
            ),
        ];
        assert_eq!(dependencies(&files), ["a::deep b", "b a::deep"]);
    }
}
