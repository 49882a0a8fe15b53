!> What the system does with files: names, copies, links, kinds.
program test_files
   use files, only: rename_file, exchange_files, delete_file, create_file, copy_file, sync_file, begin_sync, &
      & real_path, is_regular, file_identity
   use processes, only: make_folder, remove_folder
   use system_errors, only: system_reason
   use scratch, only: scratch_path, file_there, write_bytes, bytes_of
   use check, only: runs, expect, report
   implicit none (type, external)
   character(len=:), allocatable :: path, other

   path = scratch_path('a')
   other = scratch_path('b')
   if (runs('names')) call names()
   if (runs('identities')) call identities()
   if (runs('copies')) call copies()
   if (runs('kinds')) call kinds_of_files()
   if (runs('links')) call links()
   if (runs('to_disk')) call to_disk()
   call delete_file(path)
   call delete_file(other)
   call report()

contains

   subroutine names()
      logical :: ok
      call write_bytes(path, 'first')
      call write_bytes(other, 'second')
      ok = rename_file(path, other)
      call expect(ok, 'a name that another file has')
      call expect(.not. file_there(path), 'the old name is gone')
      call expect(bytes_of(other) == 'first', 'the new one has the content')
      ok = rename_file(path, other)
      call expect(.not. ok, 'what is not there cannot be renamed')
      call expect(system_reason() == 'no such file or directory', 'and the system says why: '//system_reason())
      call write_bytes(path, 'second')
      ok = exchange_files(path, other)
      call expect(ok, 'two names exchanged')
      call expect(bytes_of(path) == 'first', 'the first has the other''s content')
      call expect(bytes_of(other) == 'second', 'the other has the first''s')
      call delete_file(other)
      call delete_file(other)
      ok = exchange_files(path, other)
      call expect(.not. ok, 'there is nothing to exchange with')
      call expect(bytes_of(path) == 'first', 'and nothing changes')
   end subroutine names

   !> A file keeps its identity under another name; another file under its name, also a copy, has another.
   subroutine identities()
      character(len=:), allocatable :: first
      logical :: ok
      call delete_file(other)
      call write_bytes(path, 'x')
      first = file_identity(path)
      call expect(len(first) > 1, 'an identity: '//first)
      call expect(file_identity(other) == '', 'none where there is nothing')
      call expect(file_identity(path(:index(path, '/', back=.true.))) == '-', 'nor of a folder')
      ok = rename_file(path, other)
      call expect(file_identity(other) == first, 'a new name')
      ok = create_file(path)
      call expect(ok, 'another file')
      ok = copy_file(other, path)
      call expect(file_identity(path) /= first, 'a copy')
      call delete_file(other)
      call delete_file(path)
      call write_bytes(path, 'x')
      call expect(file_identity(path) /= first, 'a later file, though it may have the same inode')
      call execute_command_line('ln -s '//path//' '//other)
      call expect(file_identity(other) == '-', 'a link is not followed')
      call delete_file(other)
   end subroutine identities

   subroutine copies()
      logical :: ok
      call write_bytes(path, repeat('0123456789', 100000))
      call write_bytes(other, repeat('x', 2000000))
      ok = create_file(other)
      call expect(.not. ok, 'what is there is not made')
      ok = copy_file(path, other)
      call expect(ok, 'a copy over a longer file')
      call expect(bytes_of(other) == repeat('0123456789', 100000), 'has all bytes and no others')
      call write_bytes(path, '')
      ok = copy_file(path, other)
      call expect(ok, 'of nothing')
      call expect(bytes_of(other) == '', 'is nothing')
      ok = copy_file(scratch_path('none'), other)
      call expect(.not. ok, 'what is not there cannot be copied')
      call delete_file(other)
      ok = copy_file(path, other)
      call expect(.not. ok, 'nor into one that is not there')
      call execute_command_line('ln -s '//scratch_path('none')//' '//other)
      ok = create_file(other)
      call expect(.not. ok, 'a link to nothing is not followed')
      call expect(.not. file_there(scratch_path('none')), 'and nothing is made')
   end subroutine copies

   subroutine kinds_of_files()
      character(len=:), allocatable :: folder, refusal
      folder = scratch_path('folder')
      call write_bytes(path, 'x')
      call make_folder(folder, refusal)
      call expect(refusal == '', 'a folder is made')
      call make_folder(folder, refusal)
      call expect(refusal == '', 'one that is there is none to be made')
      call make_folder(folder//'/none/deep', refusal)
      call expect(refusal == 'no such file or directory', 'why none can be made: '//refusal)
      call expect(is_regular(path), 'a file')
      call expect(.not. is_regular(folder), 'a folder')
      call expect(.not. is_regular('/dev/null'), 'a device')
      call expect(.not. is_regular(scratch_path('none')), 'nothing')
      call remove_folder(folder)
      call make_folder(path//'/x', refusal)
      call expect(refusal == 'not a directory', 'a file holds no folder: '//refusal)
   end subroutine kinds_of_files

   !> Links to links, also relative ones and to nothing; a circle of them ends.
   subroutine links()
      character(len=:), allocatable :: first, second, folder
      first = scratch_path('first')
      second = scratch_path('second')
      folder = path(:index(path, '/', back=.true.))
      call write_bytes(path, 'x')
      call execute_command_line('ln -sf '//path//' '//first//' && ln -sf '//first(len(folder) + 1:)//' '//second)
      call expect(real_path(second) == real_path(path), 'a link to a link: '//real_path(second))
      call delete_file(path)
      call expect(real_path(second) == path, 'to nothing: '//real_path(second))
      call expect(real_path(folder//'./'//'.'//'/') == real_path(folder), 'a folder')
      call execute_command_line('ln -sf '//second//' '//first)
      call expect(len(real_path(second)) > 0, 'a circle')
      call delete_file(first)
      call delete_file(second)
   end subroutine links

   subroutine to_disk()
      logical :: ok
      call write_bytes(path, 'x')
      call begin_sync(path)
      call begin_sync(scratch_path('none'))
      ok = sync_file(path)
      call expect(ok, 'a file')
      ok = sync_file(path(:index(path, '/', back=.true.))//'.')
      call expect(ok, 'a folder')
      ok = sync_file(scratch_path('none'))
      call expect(.not. ok, 'nothing')
      call expect(bytes_of(path) == 'x', 'and leaves it as it is')
   end subroutine to_disk
end program test_files
